#!/bin/sh
# run_case.sh HYST CASE_DIR: runs CASE_DIR/cmd with $HYST in a temporary folder that holds the case's own files and
# those of ../shared, and compares:
#   exit      the exit code (default 0)
#   stdout    exactly; stderr line by line, where a line with a * is a shell pattern (both default to empty)
#   expected/ files that must have been written, exactly
# When the exit code is not 0, no file may have been written, changed or removed.
set -u
HYST=$1
case_dir=$(cd "$2" && pwd) || exit 99
export HYST
work=$(mktemp -d) || exit 99
trap 'rm -rf "$work"' EXIT
mkdir "$work/run"
cp "$case_dir/../shared/"* "$work/run/"
for file in "$case_dir"/*; do
    case ${file##*/} in
    cmd | exit | stdout | stderr | expected) ;;
    *) cp -R "$file" "$work/run/" ;;
    esac
done
for file in stdout stderr; do
    if [ -e "$case_dir/$file" ]; then cp "$case_dir/$file" "$work/want_$file"; else : >"$work/want_$file"; fi
done
want_exit=0
[ -e "$case_dir/exit" ] && want_exit=$(cat "$case_dir/exit")

listing() {
    (cd "$work/run" && find . -type f -exec cksum {} + | sort)
}

failed=0
fail() {
    echo "FAIL: $*"
    failed=1
}

listing >"$work/before"
(cd "$work/run" && sh "$case_dir/cmd") >"$work/stdout" 2>"$work/stderr" </dev/null
got_exit=$?
listing >"$work/after"

[ "$got_exit" = "$want_exit" ] || fail "exit code $got_exit, expected $want_exit"
cmp -s "$work/want_stdout" "$work/stdout" || fail "stdout differs: $(diff "$work/want_stdout" "$work/stdout")"

matches() {
    # The pattern is meant to expand as one.
    # shellcheck disable=SC2254
    case $1 in
    *\**) case $2 in $1) return 0 ;; esac ;;
    *) [ "$1" = "$2" ] && return 0 ;;
    esac
    return 1
}
exec 3<"$work/want_stderr" 4<"$work/stderr"
while :; do
    more_want=1
    more_got=1
    IFS= read -r want <&3 || more_want=0
    IFS= read -r got <&4 || more_got=0
    [ $more_want = 0 ] && [ $more_got = 0 ] && break
    if [ $more_want != $more_got ] || ! matches "$want" "$got"; then
        fail "stderr differs: expected '$want', got '$got'"
    fi
done
exec 3<&- 4<&-

if [ "$want_exit" != 0 ]; then
    cmp -s "$work/before" "$work/after" || fail "files were written: $(diff "$work/before" "$work/after")"
fi
if [ -d "$case_dir/expected" ]; then
    for file in "$case_dir/expected/"*; do
        name=${file##*/}
        cmp -s "$file" "$work/run/$name" || fail "$name differs: $(diff "$file" "$work/run/$name")"
    done
fi
exit $failed
