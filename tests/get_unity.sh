#!/bin/sh
# Brings the Unity test framework into build/unity. Debian ships it inside cJSON's source package; the release is
# pinned by its SHA-256. Does nothing when it is already there.
set -eu
cd "$(dirname "$0")/.."
target=build/unity
sha256=${HYST_CJSON_SHA256:-5308fd4bd90cef7aa060558514de6a1a4a0819974a26e6ed13973c5f624c24b2}
[ -f "$target/unity.c" ] && [ -f "$target/unity.h" ] && exit 0

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/lists/partial" "$work/sources"
# The machine's own archive lines, as source lines, in a list of their own.
for list in /etc/apt/sources.list /etc/apt/sources.list.d/*.list; do
    [ -f "$list" ] && sed -n 's/^deb \(.*\)/deb-src \1/p' "$list" | grep -E '(debian|ubuntu)' || true
done >"$work/sources/source.list"
for list in /etc/apt/sources.list.d/*.sources; do
    [ -f "$list" ] && grep -qE 'Suites:.*(bookworm|trixie|sid|stable|testing|jammy|noble)' "$list" || continue
    sed 's/^Types:.*/Types: deb-src/' "$list" >"$work/sources/$(basename "$list")"
done
apt="-o Dir::Etc::SourceList=/dev/null -o Dir::Etc::SourceParts=$work/sources -o Dir::State::Lists=$work/lists"
apt="$apt -o APT::Sandbox::User=root"
# shellcheck disable=SC2086
apt-get $apt update -qq
# shellcheck disable=SC2086
(cd "$work" && apt-get $apt source -qq --download-only cjson)
archive=$(ls "$work"/cjson_*.orig.tar.gz)
echo "$sha256  $archive" | sha256sum -c --quiet - || {
    echo "get_unity.sh: cJSON's source archive is not the one that was reviewed ($sha256)" >&2
    exit 1
}
mkdir -p "$work/cjson" "$target"
tar -xzf "$archive" -C "$work/cjson" --strip-components=1
cp "$work/cjson/tests/unity/src/unity.c" "$work/cjson/tests/unity/src/unity.h" \
    "$work/cjson/tests/unity/src/unity_internals.h" "$target/"
# cJSON's copy includes a configuration from its own tree, which only says that setjmp and math.h exist.
sed -i '/unity_config\.h/d' "$target/unity_internals.h"
echo "Unity is in $target"
