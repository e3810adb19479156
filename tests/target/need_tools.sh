#!/bin/sh
# need_tools.sh CORE [picolibc]: exits with 77, saying why, when images for this core of ports/cores.txt cannot be built
# and run here: HYST_HOST_ONLY=1 is set, or the compiler, the emulator or, where named, the C library is missing.
set -eu
[ "${HYST_HOST_ONLY:-0}" != 1 ] || { echo "skipped: HYST_HOST_ONLY=1"; exit 77; }
cores=$(dirname "$0")/../../ports/cores.txt
compiler=$(sed -n "s/^$1 *| *//p" "$cores" | cut -d'|' -f1 | tr -d ' ')
emulator=$(sed -n "s/^$1 *|//p" "$cores" | cut -d'|' -f3 | awk '{print $1}')
[ -n "$compiler" ] || { echo "need_tools.sh: ports/cores.txt has no core '$1'" >&2; exit 2; }
for tool in "$compiler" "$emulator"; do
    command -v "$tool" >/dev/null || { echo "skipped: no $tool"; exit 77; }
done
[ "${2:-}" != picolibc ] || "$compiler" --specs=picolibc.specs -E -x c /dev/null >/dev/null 2>&1 ||
    { echo "skipped: no picolibc for $compiler"; exit 77; }
