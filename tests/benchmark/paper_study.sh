#!/bin/sh
# paper_study.sh PAPER_STUDY DIR: the study after sections 4 and 5 of Zhang et al. 2015: tables as Markdown on stdout and
# in DIR/paper_study.md, plots as DIR/*.svg. PAPER_STUDY is the built program (ninja paper_study).
set -eu
if [ $# -ne 2 ]; then
    echo "usage: paper_study.sh PAPER_STUDY DIR" >&2
    exit 2
fi
study=$1 directory=$2
plots=$(dirname "$0")/paper_study.gnuplot

if ! command -v gnuplot >/dev/null 2>&1; then
    if [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null 2>&1; then
        apt-get install -y --no-install-recommends gnuplot-nox >/dev/null
    else
        echo "paper_study.sh: error: no gnuplot, expected it: apt install gnuplot-nox, dnf install gnuplot, brew install gnuplot" >&2
        exit 5
    fi
fi

mkdir -p "$directory"
"$study" "$directory" >"$directory/paper_study.md"
gnuplot -e "directory='$directory'" "$plots"
cat "$directory/paper_study.md"
