#!/bin/sh
# install.sh: makes sure that Python 3 with numpy and matplotlib, which this check needs, is there. As root on Debian it
# installs Debian's packages or, where python3 is another one than Debian's, with that one's pip; otherwise it names
# them and exits with 5. Says nothing when all is there.
set -eu
complete() {
    python3 -c 'import numpy, matplotlib' 2>/dev/null
}
complete && exit 0
is_debian_s() { # without one apt brings it
    ! command -v python3 >/dev/null 2>&1 || python3 -c 'import sys; sys.exit(sys.prefix != "/usr")'
}
if [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null 2>&1; then
    if is_debian_s; then
        apt-get update -qq
        DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends \
            python3 python3-numpy python3-matplotlib >/dev/null
    else
        PIP_ROOT_USER_ACTION=ignore python3 -m pip install --quiet numpy matplotlib || true
    fi
    complete && exit 0
fi
echo "hyst: missing: Python 3 with numpy and matplotlib" >&2
echo "  Debian, Ubuntu:  apt-get install python3 python3-numpy python3-matplotlib" >&2
echo "  Fedora:          dnf install python3 python3-numpy python3-matplotlib" >&2
echo "  macOS:           brew install python numpy python-matplotlib" >&2
echo "  any other one:   python3 -m pip install numpy matplotlib" >&2
exit 5
