#!/bin/sh
# qemu_run.sh CORE IMAGE: runs an image on an emulated core of cores.txt and exits as it does. 124: it did not end in
# time. -icount shift=0: one instruction is one virtual nanosecond, so the board's timer counts instructions.
set -eu
board=$(sed -n "s/^$1 *|//p" "$(dirname "$0")/cores.txt" | cut -d'|' -f3)
[ -n "$board" ] || { echo "qemu_run.sh: cores.txt has no core '$1'" >&2; exit 2; }
# shellcheck disable=SC2086
exec timeout "${HYST_QEMU_SECONDS:-120}" $board -nographic -monitor none -serial none \
    -chardev stdio,id=console -semihosting-config enable=on,target=native,chardev=console \
    -icount shift=0 -kernel "$2" </dev/null
