#!/bin/sh
# cost_table.sh [--hyst HYST] [--check README]: prints, as Markdown, what models cost on each core of ports/cores.txt and
# for each scalar: bytes of flash, RAM and stack, and instructions a sample. HYST is the hyst command (default: that of
# the release build). --check compares with what stands in README between the lines <!-- cost table --> and
# <!-- end of cost table -->, and exits with 1 when they differ. 77: the tools are not there, or others than those that the
# table was measured with.
set -eu
source=$(cd "$(dirname "$0")/../.." && pwd)
hyst=$source/build/release/host_tools/hyst readme=""
while [ $# -gt 0 ]; do
    case $1 in
    --hyst) hyst=$2 && shift 2 ;;
    --check) readme=$2 && shift 2 ;;
    *)
        echo "usage: cost_table.sh [--hyst HYST] [--check README]" >&2
        exit 2
        ;;
    esac
done
cores=$(sed -n 's/^\([a-z0-9_]*\) *|.*/\1/p' "$source/ports/cores.txt")
for core in $cores; do
    sh "$source/tests/target/need_tools.sh" "$core" picolibc
done
compilers="Measured with gcc $(arm-none-eabi-gcc -dumpversion) (Arm) and $(riscv64-unknown-elf-gcc -dumpversion) (RISC-V), -O2."
if [ -n "$readme" ]; then
    in_readme=$(sed -n '/^<!-- cost table -->$/,/^<!-- end of cost table -->$/p' "$readme" | sed '1d;$d')
    [ -n "$in_readme" ] || { echo "skipped: $readme has no cost table"; exit 77; }
    [ "$(echo "$in_readme" | head -n 1)" = "$compilers" ] || {
        echo "skipped: the table in $readme was measured with other compilers; here: $compilers"
        exit 77
    }
fi
work=$(dirname "$hyst")/../cost
mkdir -p "$work"
work=$(cd "$work" && pwd)

# Headers: a folder a scalar that this hyst can emit.
scalars=""
for scalar in f32 q31 q15; do
    scalars="$scalars $scalar"
    mkdir -p "$work/headers/$scalar"
    for plays in 5 8 32 128; do
        awk -v plays=$plays -f "$source/tests/target/cost_model.awk" >"$work/film_$plays.json"
        "$hyst" emit "$work/film_$plays.json" --scalar $scalar --symbol cost_$plays \
            -o "$work/headers/$scalar/cost_$plays.h" --quiet
    done
done

text_bytes() { # text_bytes CORE IMAGE
    case $1 in
    rv32*) riscv64-unknown-elf-size "$2" ;;
    *) arm-none-eabi-size "$2" ;;
    esac | awk 'NR == 2 { print $1 + $2 }'
}

# One line a measurement: scalar core, then names with values.
measure() { # measure CORE
    build=$work/$1
    cmake -S "$source" -B "$build" -G Ninja -DCMAKE_TOOLCHAIN_FILE="$source/ports/toolchain.cmake" -DHYST_CORE="$1" \
        -DCMAKE_BUILD_TYPE=Release -DHYST_BUILD_HOST_TOOLS=OFF -DHYST_BUILD_TESTS=ON \
        -DHYST_COST_HEADERS="$work/headers" >"$build.log" 2>&1 &&
        cmake --build "$build" --target cost >>"$build.log" 2>&1 || { cat "$build.log" >&2; exit 1; }
    for scalar in $scalars; do
        images=$build/tests/target/cost
        none=$(text_bytes "$1" "$images/size_${scalar}_0.elf")
        line="$scalar $1 code"
        for parts in 1 2 3; do
            line="$line part_$parts $(($(text_bytes "$1" "$images/size_${scalar}_$parts.elf") - none))"
        done
        echo "$line"
        sh "$source/ports/qemu_run.sh" "$1" "$images/cost_$scalar.elf" >"$build/cost_$scalar.txt" ||
            { cat "$build/cost_$scalar.txt" >&2; exit 1; }
        sed "s/^/$scalar $1 /" "$build/cost_$scalar.txt"
    done
}
for core in $cores; do
    measure "$core"
done >"$work/measured.txt"
{
    echo "$compilers"
    echo
    awk -f "$source/tests/target/cost_table.awk" "$work/measured.txt"
} >"$work/table.md"

if [ -z "$readme" ]; then
    cat "$work/table.md"
elif ! echo "$in_readme" | diff - "$work/table.md"; then
    echo "cost_table.sh: the table in $readme (<) is not what is measured (>)" >&2
    exit 1
fi
