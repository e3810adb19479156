#!/bin/sh
# chain.sh SOURCE BUILD HYST RECORD [UNSEEN]: the whole chain on a measured record: identify to <= 0.8 % of range (the
# bound the project sets itself), compress 30 plays to 8, emit, compile, self-test on this machine and, where the tools
# are, on an emulated Cortex-M4F with the same bits. With UNSEEN it prints how well the model predicts that record.
# 77: the record is not there.
set -eu
source=$1 build=$2 hyst=$3 record=$4 unseen=${5:-}
[ -f "$record" ] || { echo "skipped: no measured record $(basename "$record")"; exit 77; }
mkdir -p "$build"

key() { # key NAME FILE: a number of a JSON result
    sed -n "s/.*\"$1\": *\([-0-9.e+]*\).*/\1/p" "$2" | head -n 1
}
at_most() { # at_most WHAT VALUE LIMIT
    awk -v x="$2" -v limit="$3" 'BEGIN { exit !(x <= limit) }' || { echo "$1 is $2, expected at most $3"; exit 1; }
}

"$hyst" identify "$record" -o "$build/full.json" --json >"$build/identify.json"
relative=$(key relative "$build/identify.json")
echo "identify: rmse $relative of range"
at_most "the fit's error" "$relative" 0.008
if [ -n "$unseen" ]; then
    "$hyst" simulate "$build/full.json" "$unseen" -o "$build/predicted.csv" --json >"$build/predict.json"
    echo "prediction of $(basename "$unseen"): rmse $(key relative "$build/predict.json") of range"
fi

"$hyst" compress "$build/full.json" --plays 8 --cost entropy-sum -o "$build/small.json" --json >"$build/compress.json"
"$hyst" simulate "$build/full.json" "$record" -o "$build/full.csv"
"$hyst" simulate "$build/small.json" "$build/full.csv" -o "$build/small.csv" --json >"$build/difference.json"
bound=$(key error_bound "$build/compress.json")
echo "compress: largest difference $(key max_error "$build/difference.json"), certified $bound"
# Both files carry numbers of 15 digits.
at_most "the compression's error" "$(key max_error "$build/difference.json")" "$(awk -v b="$bound" 'BEGIN { print b + 1e-9 }')"

"$hyst" emit "$build/small.json" -o "$build/model.h" --symbol model
cmake -S "$source" -B "$build/host" -G Ninja -DHYST_BUILD_HOST_TOOLS=OFF -DHYST_BUILD_TESTS=OFF \
    -DHYST_MODEL_HEADER="$build/model.h" -DHYST_MODEL_SYMBOL=model >/dev/null
cmake --build "$build/host" >/dev/null
"$build/host/ports/self_test"
status=0
sh "$source/tests/ports/same_bits.sh" "$source" "$build/cortex_m4f" "$build/model.h" model "$build/host/ports/self_test" ||
    status=$?
[ $status = 0 ] || [ $status = 77 ] || exit $status
