#!/bin/sh
# same_bits.sh SOURCE BUILD HEADER SYMBOL HOST_SELF_TEST: builds the self-test firmware of a model for a Cortex-M4F, runs
# it under emulation and beside it on the host; both must pass, with the same checksum. 77: the tools are not there.
set -eu
source=$1 build=$2 header=$3 symbol=$4 host_self_test=$5
[ -z "${HYST_HOST_ONLY:-}" ] || { echo "skipped: host only"; exit 77; }
for tool in arm-none-eabi-gcc qemu-system-arm; do
    command -v "$tool" >/dev/null || { echo "skipped: no $tool"; exit 77; }
done
cmake -S "$source" -B "$build" -G Ninja -DCMAKE_TOOLCHAIN_FILE="$source/ports/cortex_m/toolchain_cortex_m4f.cmake" \
    -DCMAKE_BUILD_TYPE=Release -DHYST_BUILD_HOST_TOOLS=OFF -DHYST_BUILD_TESTS=OFF \
    -DHYST_MODEL_HEADER="$header" -DHYST_MODEL_SYMBOL="$symbol" >/dev/null
cmake --build "$build" >/dev/null
"$host_self_test" >"$build/host.txt" || { cat "$build/host.txt"; exit 1; }
sh "$source/ports/cortex_m/qemu_run.sh" "$build/ports/self_test.elf" >"$build/target.txt" ||
    { cat "$build/target.txt"; exit 1; }
cat "$build/target.txt"
# All but the instruction counts, and the bytes, which have other pointers, is the same text.
for run in host target; do
    grep -v -e '^model:' -e '^smooth:' -e '^jumps:' "$build/$run.txt" >"$build/$run.bits"
done
grep -q '^checksum: *0x' "$build/target.bits"
diff "$build/host.bits" "$build/target.bits"
