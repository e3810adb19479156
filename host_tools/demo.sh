#!/bin/sh
# demo.sh [RECORD.csv]: from a record to firmware that runs its model: identify, compress 30 plays to 5, emit, build for
# a Cortex-M4F, run forward and inverse under emulation. Without a record it makes one of the paper's VO2 film. Without
# the cross toolchain it runs the same firmware code on this machine, and says so.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
record=""
if [ $# -gt 0 ]; then
    record=$(cd "$(dirname "$1")" && pwd)/$(basename "$1")
fi
cd "$root"
plays=5
out=build/demo
mkdir -p "$out"

sh host_tools/install.sh
if sh host_tools/install.sh target 2>"$out/target_missing.txt"; then
    target=yes
else
    target=no
fi

echo "building hyst ..."
cmake --preset release -DHYST_BUILD_TESTS=OFF -DHYST_MODEL_HEADER= -B "$out/host" >"$out/build.log" 2>&1 &&
    cmake --build "$out/host" >>"$out/build.log" 2>&1 || { cat "$out/build.log" >&2; exit 1; }
hyst=$out/host/host_tools/hyst

if [ -z "$record" ]; then
    record=$out/vo2_film.csv
    sh host_tools/demo/vo2_film_record.sh "$hyst" >"$record"
    echo "record: the VO2 film (envelopes of Zhang et al. 2015, Table 6; weights ours), noise 0.005 on the output"
    name=vo2_film
    set -- --input-unit degC --output-unit "-log10(ohm)"
    range="--input-range 30,90"
else
    name=demo
    set --
    range=""
fi
"$hyst" --version

figure() { # figure KEY FILE: the number behind a key of a JSON result
    sed -n "s/.*\"$1\": *\([-0-9.e+]*\).*/\1/p" "$2" | head -n 1
}
macro() { # macro NAME: the number that the header gives under it
    sed -n "s/^#define [A-Z0-9_]*_$1 *\([-0-9.e+]*\).*/\1/p" "$out/$name.h" | head -n 1
}

# shellcheck disable=SC2086
"$hyst" identify "$record" -o "$out/full.json" --name "$name" --json $range "$@" >"$out/identify.json"
"$hyst" simulate "$out/full.json" "$record" -o "$out/full.csv" --json >"$out/full_fit.json"
"$hyst" compress "$out/full.json" --plays $plays --cost entropy-sum -o "$out/small.json" --json >"$out/compress.json"
"$hyst" simulate "$out/small.json" "$record" -o "$out/small.csv" --json >"$out/small_fit.json"
"$hyst" invert "$out/small.json" "$record" -o "$out/inverse.csv" --json >"$out/inverse.json"
"$hyst" emit "$out/small.json" -o "$out/$name.h" --symbol "$name"

run_firmware() { # run_firmware PRESET BUILD-FOLDER RUN...: builds the self-test and prints what it says
    preset=$1 folder=$2
    shift 2
    rm -rf "$folder" # a former version's may name a toolchain that has moved
    cmake --preset "$preset" -B "$folder" -DHYST_BUILD_HOST_TOOLS=OFF -DHYST_BUILD_TESTS=OFF \
        -DHYST_MODEL_HEADER="$root/$out/$name.h" -DHYST_MODEL_SYMBOL="$name" >"$out/firmware.log" 2>&1 &&
        cmake --build "$folder" >>"$out/firmware.log" 2>&1 || { cat "$out/firmware.log" >&2; exit 1; }
    "$@"
}
run_firmware release "$out/firmware_host" "$out/firmware_host/ports/self_test" >"$out/firmware_host.txt"
if [ $target = yes ]; then
    run_firmware cortex-m4f "$out/firmware_m4f" sh ports/qemu_run.sh cortex_m4f "$out/firmware_m4f/ports/self_test.elf" \
        >"$out/firmware_m4f.txt"
fi

percent() {
    awk -v x="$1" 'BEGIN { printf "%.3f %%", 100 * x }'
}
echo
echo "step      figures"
echo "record    $(figure samples "$out/full_fit.json") samples"
echo "identify  30 plays, rmse $(percent "$(figure relative "$out/identify.json")") of range"
echo "compress  $plays plays, rmse $(percent "$(figure relative "$out/small_fit.json")") of range," \
    "worst case $(figure error_bound "$out/compress.json")"
echo "invert    $(figure clamped "$out/inverse.json") of $(figure samples "$out/inverse.json") wanted outputs clamped"
echo "emit      $(macro FLASH_BYTES) bytes of flash, $(macro RAM_BYTES) of RAM, table error $(macro TABLE_ERROR)"
echo
echo "firmware on this machine:"
sed 's/^/  /' "$out/firmware_host.txt"
if [ $target = yes ]; then
    echo "firmware on an emulated Cortex-M4F:"
    sed 's/^/  /' "$out/firmware_m4f.txt"
    host_sum=$(sed -n 's/.*checksum[^0-9a-fx]*//p' "$out/firmware_host.txt")
    target_sum=$(sed -n 's/.*checksum[^0-9a-fx]*//p' "$out/firmware_m4f.txt")
    if [ -z "$host_sum" ] || [ "$host_sum" != "$target_sum" ]; then
        echo "demo.sh: host and target give different bits: $host_sum and $target_sum" >&2
        exit 1
    fi
    echo "the bits are the same on both"
else
    echo "no Cortex-M toolchain: the same firmware code ran on this machine only"
    cat "$out/target_missing.txt"
fi
echo
echo "files in $out: $(basename "$record"), full.json, small.json, $name.h, full.csv, small.csv, inverse.csv"
