#!/bin/sh
# readme_snippet.sh SOURCE BUILD HYST: README's firmware snippet, cut out and compiled against a header emitted from the
# demo's model, as C11 and as C++17.
set -eu
source=$1 build=$2 hyst=$3
mkdir -p "$build"
"$hyst" compress "$source/host_tools/demo/vo2_film.json" --plays 5 --cost entropy-sum -o "$build/small.json" --json >/dev/null
"$hyst" emit "$build/small.json" --symbol vo2_film -o "$build/vo2_film.h"
awk '/^```c$/ { inside = 1; next } /^```$/ { inside = 0 } inside' "$source/README.md" >"$build/snippet.c"
grep -q hyst_f32_inverse "$build/snippet.c"
flags="-Wall -Wextra -Wpedantic -Werror -I$build -I$source/lib/include"
# shellcheck disable=SC2086
gcc -std=c11 $flags -c "$build/snippet.c" -o "$build/snippet.o"
# shellcheck disable=SC2086
g++ -x c++ -std=c++17 $flags -c "$build/snippet.c" -o "$build/snippet_cpp.o"
