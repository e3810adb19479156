#!/bin/sh
# freestanding.sh SOURCE BUILD CORE: the library as built for a core of ports/cores.txt calls nothing outside itself but
# the compiler's own arithmetic, none of it in double precision, and memcpy and memset, which gcc asks of every
# freestanding program (ports/emulated/memory.c); it has no writable data. 77: the tools are not there.
set -eu
source=$1 build=$2 core=$3
sh "$source/tests/target/need_tools.sh" "$core"
cmake -S "$source" -B "$build" -G Ninja -DCMAKE_TOOLCHAIN_FILE="$source/ports/toolchain.cmake" -DHYST_CORE="$core" \
    -DCMAKE_BUILD_TYPE=Release -DHYST_BUILD_HOST_TOOLS=OFF -DHYST_BUILD_TESTS=OFF >"$build.log" 2>&1 &&
    cmake --build "$build" --target hyst >>"$build.log" 2>&1 || { cat "$build.log"; exit 1; }
prefix=$(sed -n "s/^$core *| *\([^ ]*\)gcc .*/\1/p" "$source/ports/cores.txt")
# The compiler's names begin with two underscores; those of double precision with __aeabi_d or hold a df.
outside=$("${prefix}nm" -u "$build/lib/libhyst.a" |
    awk '$1 == "U" && $2 !~ /^mem(cpy|set)$/ && ($2 !~ /^(hyst_|__)/ || $2 ~ /^__aeabi_d|^__.*df/) { print "  " $2 }' | sort -u)
[ -z "$outside" ] || { echo "the library calls:"; echo "$outside"; exit 1; }
"${prefix}size" -t "$build/lib/libhyst.a" |
    awk '/TOTALS/ { print $1 " bytes of code, " $2 + $3 " of writable data"; exit !($1 > 0 && $2 + $3 == 0) }'
