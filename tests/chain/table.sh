#!/bin/sh
# table.sh HYST DATA: README's table of fits as Markdown: each measured record identified with the defaults, and how well
# the model predicts another record of the same specimen. Errors are RMSE in % of the output's range.
set -eu
hyst=$1 data=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

key() {
    sed -n "s/.*\"$1\": *\"\{0,1\}\([-0-9a-z.e+]*\).*/\1/p" "$2" | head -n 1
}
percent() {
    awk -v x="$1" 'BEGIN { printf "%.2f %%", 100 * x }'
}
row() { # row RECORD [UNSEEN]
    begin=$(date +%s%N)
    "$hyst" identify "$data/$1" -q -o "$work/model.json" --json >"$work/identify.json"
    seconds=$(awk -v ns=$(($(date +%s%N) - begin)) 'BEGIN { printf "%.1f", ns / 1e9 }')
    range=$(awk -v a="$(key rmse "$work/identify.json")" -v b="$(key relative "$work/identify.json")" 'BEGIN { print a / b }')
    floor=$(awk -v f="$(key monotone_floor "$work/identify.json")" -v r="$range" 'BEGIN { print f / r }')
    predicted=""
    if [ $# -gt 1 ]; then
        "$hyst" simulate "$work/model.json" "$data/$2" -q -o "$work/out.csv" --json >"$work/simulate.json"
        predicted="$(basename "$2" .csv): $(percent "$(key relative "$work/simulate.json")")"
    fi
    echo "| $(basename "$1" .csv) | $(key ascending "$work/identify.json") + $(key nonhysteretic "$work/identify.json")" \
        "| $(percent "$(key relative "$work/identify.json")") | $(percent "$floor") | $seconds s | $predicted |"
}

echo "| record | envelopes + non-hysteretic part | fit | no GPI model below | time | prediction of another record |"
echo "|---|---|---|---|---|---|"
row piezo_stack/loop_1hz.csv piezo_stack/varied.csv
row piezo_stack/varied.csv piezo_stack/loop_1hz.csv
for specimen in m130_27s:3 mnzn:4 mnzn_hp:4; do
    name=${specimen%:*} count=${specimen#*:}
    while [ "$count" -gt 1 ]; do
        row "magnetic_loops/${name}_$count.csv" "magnetic_loops/${name}_$((count - 1)).csv"
        count=$((count - 1))
    done
    row "magnetic_loops/${name}_1.csv"
done
for seal in circle kidney; do
    row "pneumatic_piston/${seal}_1bar.csv"
    row "pneumatic_piston/${seal}_7bar.csv"
done
