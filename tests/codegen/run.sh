#!/bin/sh
# run.sh HYST LIBRARY INCLUDE_FOLDER MODEL SCALAR: emits MODEL as a header, compiles it with every compiler at hand,
# as C and as C++, and holds what it computes against `hyst simulate` within the bounds that the header states.
set -eu
hyst=$1 library=$2 include=$3 model=$4 scalar=$5
here=$(dirname "$0")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT INT TERM
strict="-Wall -Wextra -Wpedantic -Werror -ffp-contract=off"

"$hyst" emit "$model" -o "$scratch/subject.h" --symbol subject --scalar "$scalar"
mkdir "$scratch/elsewhere"
cp "$model" "$scratch/elsewhere/renamed.json"
(cd "$scratch/elsewhere" && LC_ALL=de_DE.UTF-8 "$hyst" emit renamed.json --symbol subject --scalar "$scalar") > "$scratch/again.h"
cmp "$scratch/subject.h" "$scratch/again.h"

num_compilers=0
check() { # COMPILER STANDARD LANGUAGE
    if ! command -v "$1" > /dev/null; then
        echo "skipped: no $1"
        return
    fi
    # shellcheck disable=SC2086
    if ! printf 'int main(void) { return 0; }\n' | "$1" ${HYST_CODEGEN_FLAGS:-} -x "$3" - -o "$scratch/empty" 2> /dev/null
    then
        echo "skipped: $1 cannot link with ${HYST_CODEGEN_FLAGS:-}"
        return
    fi
    num_compilers=$((num_compilers + 1))
    # shellcheck disable=SC2086
    "$1" "-std=$2" $strict ${HYST_CODEGEN_FLAGS:-} -I"$include" -I"$scratch" '-DHEADER="subject.h"' "-DSCALAR=$scalar" "-DSCALAR_$scalar" -x "$3" \
        "$here/check.c" -x none "$library" -o "$scratch/check"
    "$scratch/check"
    "$scratch/check" inputs > "$scratch/in.csv"
    "$hyst" simulate "$model" "$scratch/in.csv" -o "$scratch/out.csv" > /dev/null
    echo "$1 -std=$2: $("$scratch/check" compare < "$scratch/out.csv")"
    "$scratch/check" compare < "$scratch/out.csv" > /dev/null
}
check gcc c11 c
check clang c11 c
check g++ c++17 c++
check g++ c++20 c++
check clang++ c++17 c++
check clang++ c++20 c++
test "$num_compilers" -gt 0

# A header made for another layout must not compile.
cp -R "$include" "$scratch/include"
sed 's/^#define HYST_MODEL_FORMAT [0-9]*$/#define HYST_MODEL_FORMAT 9999/' "$include/hyst/hyst.h" \
    > "$scratch/include/hyst/hyst.h"
printf '#include "subject.h"\n' > "$scratch/other.c"
if "${CC:-cc}" -std=c11 -I"$scratch/include" -I"$scratch" -c "$scratch/other.c" -o "$scratch/other.o" \
    2> "$scratch/message"; then
    echo "a header for another model format compiled"
    exit 1
fi
grep -q "Regenerate this header" "$scratch/message"
