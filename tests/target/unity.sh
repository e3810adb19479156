#!/bin/sh
# unity.sh SOURCE BUILD CORE LAYER: builds the library's Unity tests of a layer (unit, property) for a core of
# ports/cores.txt and runs each image under emulation. Prints Unity's summary of each, and in full what failed. 77: the
# tools are not there.
set -eu
source=$1 build=$2 core=$3 layer=$4
sh "$source/tests/target/need_tools.sh" "$core" picolibc
cmake -S "$source" -B "$build" -G Ninja -DCMAKE_TOOLCHAIN_FILE="$source/ports/toolchain.cmake" -DHYST_CORE="$core" \
    -DCMAKE_BUILD_TYPE=Release -DHYST_BUILD_HOST_TOOLS=OFF -DHYST_BUILD_TESTS=ON >"$build.log" 2>&1 &&
    cmake --build "$build" --target "target_$layer" >>"$build.log" 2>&1 || { cat "$build.log"; exit 1; }
export HYST_QEMU_SECONDS="${HYST_QEMU_SECONDS:-400}"
failed=0 count=0
for image in "$build/tests/target/$layer".*.elf; do
    name=$(basename "$image" .elf)
    status=0
    sh "$source/ports/qemu_run.sh" "$core" "$image" >"$build/$name.txt" 2>&1 || status=$?
    if [ $status -ne 0 ] || ! grep -q '^[1-9][0-9]* Tests 0 Failures' "$build/$name.txt"; then
        cat "$build/$name.txt"
        echo "$name: exit code $status"
        failed=1
    else
        echo "$name: $(grep 'Failures' "$build/$name.txt")"
    fi
    count=$((count + 1))
done
[ $count -gt 0 ] && exit $failed
