#!/bin/sh
# install.sh [report] [tests] [target]: makes sure that what the build needs is on this machine. As root on Debian it
# installs with apt-get; otherwise it names the packages and exits with 5. Says nothing when all is there.
set -eu

have_command() {
    command -v "$1" >/dev/null 2>&1
}

have_header() {
    echo "#include <$1>" | "${CC:-cc}" -E - >/dev/null 2>&1
}

have_specs() { # have_specs COMPILER: whether it finds picolibc
    have_command "$1" && "$1" --specs=picolibc.specs -E -x c /dev/null >/dev/null 2>&1
}

missing=""
need() { # need WHAT-IS-MISSING APT DNF BREW
    missing="$missing $1"
    apt="${apt:-} $2" dnf="${dnf:-} $3" brew="${brew:-} $4"
}

check_build() {
    have_command cc || need "C compiler" gcc gcc gcc
    have_command cmake || need cmake cmake cmake cmake
    have_command ninja || need ninja ninja-build ninja-build ninja
    have_command pkg-config || need pkg-config pkg-config pkgconf pkgconf
    have_command cc && have_command pkg-config || return 0
    pkg-config --exists jansson || need jansson libjansson-dev jansson-devel jansson
    pkg-config --exists popt || need popt libpopt-dev popt-devel popt
    pkg-config --exists cminpack || need cminpack libcminpack-dev cminpack-devel cminpack
    pkg-config --exists lapacke || need lapacke liblapacke-dev lapack-devel lapack
    pkg-config --exists openblas || need openblas libopenblas-dev openblas-devel openblas
    pkg-config --exists kissfft-float || need kissfft libkissfft-dev "'pkgconfig(kissfft-float)'" kissfft
    have_header csv.h || need libcsv libcsv-dev libcsv-devel libcsv
}

check_report() {
    have_command gnuplot || need gnuplot gnuplot-nox gnuplot gnuplot
}

check_tests() {
    have_command g++ || need "C++ compiler" g++ gcc-c++ gcc
    have_command clang || need clang clang clang llvm
    check_report
    have_command clang-format || need clang-format clang-format clang-tools-extra clang-format
    have_command dpkg-source || need dpkg-source dpkg-dev dpkg-dev dpkg
}

check_target() {
    have_command arm-none-eabi-gcc || need arm-none-eabi-gcc gcc-arm-none-eabi arm-none-eabi-gcc-cs arm-none-eabi-gcc
    have_command qemu-system-arm || need qemu-system-arm qemu-system-arm qemu-system-arm qemu
    have_command riscv64-unknown-elf-gcc || need riscv64-unknown-elf-gcc gcc-riscv64-unknown-elf "" ""
    have_command qemu-system-riscv32 || need qemu-system-riscv32 qemu-system-misc qemu-system-riscv qemu
    have_specs arm-none-eabi-gcc || need picolibc-for-Arm picolibc-arm-none-eabi "" ""
    have_specs riscv64-unknown-elf-gcc || need picolibc-for-RISC-V picolibc-riscv64-unknown-elf "" ""
}

check_all() {
    missing="" apt="" dnf="" brew=""
    check_build
    for set in "$@"; do
        "check_$set"
    done
}

check_all "$@"
[ -z "$missing" ] && exit 0
if [ "$(id -u)" = 0 ] && have_command apt-get; then
    # Twice: what pkg-config would find is known only once there is a pkg-config.
    for round in 1 2; do
        [ -n "$apt" ] || break
        [ "$round" = 2 ] || apt-get update -qq
        # shellcheck disable=SC2086
        DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $apt >/dev/null
        check_all "$@"
    done
    [ -z "$missing" ] && exit 0
fi
echo "hyst: missing:$missing" >&2
echo "  Debian, Ubuntu:  apt-get install$apt" >&2
echo "  Fedora:          dnf install$dnf" >&2
echo "  macOS:           brew install$brew" >&2
exit 5
