#!/bin/sh
# same_bits.sh SOURCE BUILD HEADER SYMBOL HOST_SELF_TEST [CORE [SCALAR]]: builds the self-test firmware of a model for a core of
# ports/cores.txt (default cortex_m4f), runs it under emulation and beside it on the host; both must pass,
# with the same checksum. 77: the tools are not there.
set -eu
source=$1 build=$2 header=$3 symbol=$4 host_self_test=$5 core=${6:-cortex_m4f} scalar=${7:-f32}
sh "$source/tests/target/need_tools.sh" "$core"
cmake -S "$source" -B "$build" -G Ninja -DCMAKE_TOOLCHAIN_FILE="$source/ports/toolchain.cmake" -DHYST_CORE="$core" \
    -DCMAKE_BUILD_TYPE=Release -DHYST_BUILD_HOST_TOOLS=OFF -DHYST_BUILD_TESTS=OFF \
    -DHYST_MODEL_HEADER="$header" -DHYST_MODEL_SYMBOL="$symbol" -DHYST_MODEL_SCALAR="$scalar" >"$build.log" 2>&1 &&
    cmake --build "$build" --target self_test >>"$build.log" 2>&1 || { cat "$build.log"; exit 1; }
"$host_self_test" >"$build/host.txt" || { cat "$build/host.txt"; exit 1; }
sh "$source/ports/qemu_run.sh" "$core" "$build/ports/self_test.elf" >"$build/target.txt" ||
    { cat "$build/target.txt"; exit 1; }
cat "$build/target.txt"
# All but the instruction counts, and the bytes, which have other pointers, is the same text.
for run in host target; do
    grep -v -e '^model:' -e '^smooth:' -e '^jumps:' "$build/$run.txt" >"$build/$run.bits"
done
grep -q '^checksum: *0x' "$build/target.bits"
diff "$build/host.bits" "$build/target.bits"
