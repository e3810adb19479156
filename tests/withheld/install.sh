#!/bin/sh
# install.sh: makes sure that Python 3 with numpy and matplotlib, which this check needs, is there. As root on Debian it
# installs Debian's packages; otherwise it names them and exits with 5. Says nothing when all is there.
set -eu
complete() {
    python3 -c 'import numpy, matplotlib' 2>/dev/null
}
complete && exit 0
if [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null 2>&1; then
    apt-get update -qq
    DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends \
        python3 python3-numpy python3-matplotlib >/dev/null
    complete && exit 0
fi
echo "hyst: missing: Python 3 with numpy and matplotlib" >&2
echo "  Debian, Ubuntu:  apt-get install python3 python3-numpy python3-matplotlib" >&2
echo "  Fedora:          dnf install python3 python3-numpy python3-matplotlib" >&2
echo "  macOS:           brew install python numpy python-matplotlib" >&2
exit 5
