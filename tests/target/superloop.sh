#!/bin/sh
# superloop.sh SOURCE BUILD CORE HEADER HOST_EXAMPLE: builds the super-loop example for a Cortex-M of ports/cores.txt, runs
# it under emulation and on the host; both must pass and say the same. 77: the tools are not there.
set -eu
source=$1 build=$2 core=$3 header=$4 host_example=$5
sh "$source/tests/target/need_tools.sh" "$core"
cmake -S "$source" -B "$build" -G Ninja -DCMAKE_TOOLCHAIN_FILE="$source/ports/toolchain.cmake" -DHYST_CORE="$core" \
    -DCMAKE_BUILD_TYPE=Release -DHYST_BUILD_HOST_TOOLS=OFF -DHYST_BUILD_TESTS=OFF \
    -DHYST_ACTUATOR_HEADER="$header" >"$build.log" 2>&1 &&
    cmake --build "$build" --target example_superloop >>"$build.log" 2>&1 || { cat "$build.log"; exit 1; }
"$host_example" >"$build/host.txt" || { cat "$build/host.txt"; exit 1; }
sh "$source/ports/qemu_run.sh" "$core" "$build/ports/example_superloop/example_superloop.elf" >"$build/target.txt" ||
    { cat "$build/target.txt"; exit 1; }
cat "$build/target.txt"
diff "$build/host.txt" "$build/target.txt"
