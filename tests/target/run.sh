#!/bin/sh
# run.sh HYST: passes all tests on emulated target cores, and the measured records' chain down to them, against the host build that HYST, the hyst command, stands in.
set -eu
build=$(cd "$(dirname "$1")/.." && pwd)
jobs=$(getconf _NPROCESSORS_ONLN)
exec ctest --test-dir "$build" -R '^(target|chain)\.' -j "$jobs" --output-on-failure --no-tests=error
