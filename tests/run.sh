#!/bin/sh
# run.sh [--host-only]: builds and passes all tests: gcc, clang and sanitizers on this machine, then on all
# target cores of ports/cores.txt under emulation, bit for bit against this machine.
set -eu
cd "$(dirname "$0")/.."
target=yes
for option in "$@"; do
    case $option in
    --host-only) target=no ;;
    *)
        echo "usage: run.sh [--host-only]" >&2
        exit 2
        ;;
    esac
done

stage() {
    echo
    echo "== $*"
}
jobs=$(getconf _NPROCESSORS_ONLN)

stage "what is needed"
if [ $target = yes ]; then
    sh host_tools/install.sh tests target
else
    sh host_tools/install.sh tests
fi
sh tests/get_unity.sh
sh tests/withheld/install.sh || echo "without them the withheld check is skipped" >&2

stage "layout (clang-format)"
git ls-files '*.c' '*.h' ':!tests/golden' | xargs clang-format --dry-run -Werror

for preset in release clang sanitize; do
    stage "$preset"
    cmake --preset $preset >/dev/null
    cmake --build --preset $preset
    HYST_HOST_ONLY=1 ctest --preset $preset -j "$jobs"
done

if [ $target = yes ]; then
    stage "target cores under emulation"
    sh tests/target/run.sh build/release/host_tools/hyst
else
    echo "skipped: target cores (--host-only)"
fi
