#!/usr/bin/env python3
"""Draws withheld cases, has `hyst` diagnose them, and holds the verdicts against the sealed truths.

Exit codes: 0 all limits held but open ones (thresholds.py), 1 another was missed, 2 usage, 77 this hyst has no `diagnose`."""
import argparse
import json
import multiprocessing.pool
import os
import subprocess
import sys
import time

import measured
from draw import SEEDS
from generate import folders, generate
from score import scoreboard
from text_page import text
from trial import run_trial
from verdicts import row_of

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", choices=sorted(SEEDS), required=True)
    parser.add_argument("--cases", type=int, default=300)
    parser.add_argument("--hyst", required=True, help="the command to check")
    parser.add_argument("--out", help="folder for cases, results and scoreboard (default: build/withheld/SEED)")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--measured", default=os.path.join(ROOT, "..", "shared", "data"),
                        help="folder with the measured records; left out where it is missing")
    options = parser.parse_args()
    if options.cases < 1 or options.jobs < 1:
        parser.error("--cases and --jobs are at least 1")
    options.out = options.out or os.path.join(ROOT, "build", "withheld", options.seed)
    return options


def can_diagnose(hyst):
    try:
        asked = subprocess.run([hyst, "diagnose", "--help"], capture_output=True, check=False)
    except OSError as error:
        sys.exit("run.py: %s: %s" % (hyst, error.strerror))
    return asked.returncode == 0


def in_parallel(jobs, count, what, function, items):
    """Results in the items' order; tells on stderr how far it is."""
    start, out = time.monotonic(), []
    with multiprocessing.pool.ThreadPool(jobs) as pool:
        for result in pool.imap(function, items):
            out.append(result)
            print("\r%s %d of %d, %.0f s " % (what, len(out), count, time.monotonic() - start), end="", file=sys.stderr)
    print(file=sys.stderr)
    return out


def made_up(options):
    names = generate(options.seed, options.cases, options.out, options.jobs)

    def trial(name):
        folder, _sealed = folders(options.seed, options.out, name)
        return run_trial(options.hyst, folder, os.path.join(options.out, "work", name))

    results = in_parallel(options.jobs, len(names), "case", trial, names)
    # Every diagnosis is in before the first truth is opened.
    rows = []
    for name, result in zip(names, results):
        folder, sealed = folders(options.seed, options.out, name)
        rows.append({"case": name, **row_of(result, folder, sealed, os.path.join(options.out, "work", name))})
    return rows


def from_machines(options):
    if not os.path.isdir(options.measured):
        print("skipped: no measured records in %s" % options.measured, file=sys.stderr)
        return []
    names = measured.write(options.measured, options.out)

    def trial(name):
        return run_trial(options.hyst, os.path.join(options.out, "measured", name),
                         os.path.join(options.out, "work", name))

    results = in_parallel(options.jobs, len(names), "measured", trial, names)
    return [measured.judge(name, result, options.out) for name, result in zip(names, results)]


def write_all(options, board, rows):
    from html_page import page  # matplotlib takes a second to load; nothing before needs it

    files = {"rows.json": json.dumps(rows, indent=1), "scoreboard.json": json.dumps(board, indent=1),
             "scoreboard.txt": text(board), "scoreboard.html": page(board, rows)}
    for name, content in files.items():
        with open(os.path.join(options.out, name), "w", encoding="utf-8") as file:
            file.write(content)


def main():
    options = arguments()
    if not can_diagnose(options.hyst):
        print("skipped: %s has no diagnose" % options.hyst, file=sys.stderr)
        return 77
    rows = made_up(options)
    board = scoreboard(rows, from_machines(options))
    board["command"] = "python3 tests/withheld/run.py --seed %s --cases %d" % (options.seed, options.cases)
    write_all(options, board, rows)
    print(text(board))
    return 1 if any(line["holds"] is False and not line["open"] for line in board["limits"]) else 0


if __name__ == "__main__":
    sys.exit(main())
