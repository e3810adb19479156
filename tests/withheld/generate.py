#!/usr/bin/env python3
"""Writes withheld cases: OUT/cases/NNN/{calibration,record,test}.csv and, apart, OUT/sealed/NNN/truth.json with what
the effect adds to each sample. The tuning seed is open: its truths stand beside the records, in OUT/NNN/."""
import argparse
import json
import multiprocessing
import os
import sys
import time

import numpy as np

from case import Case
from draw import SEEDS, deck


def _write_csv(path, columns):
    np.savetxt(path, np.column_stack(list(columns.values())), fmt="%.9g", delimiter=",",
               header=",".join(columns), comments="")


def folders(seed_name, out, name):
    """Where a case's records and its truth go: together for the open tuning seed, apart for the others."""
    if seed_name == "tuning":
        return os.path.join(out, name), os.path.join(out, name)
    return os.path.join(out, "cases", name), os.path.join(out, "sealed", name)


def write_case(job):
    seed_name, card, out = job
    parts, truth = Case(seed_name, card).build()
    name = "%03d" % card["index"]
    folder, sealed = folders(seed_name, out, name)
    os.makedirs(folder, exist_ok=True)
    os.makedirs(sealed, exist_ok=True)
    for part, (columns, effect) in parts.items():
        _write_csv(os.path.join(folder, part + ".csv"), columns)
        if part != "calibration":
            np.savetxt(os.path.join(sealed, part + "_effect.txt"), effect, fmt="%.6g")
    with open(os.path.join(sealed, "truth.json"), "w", encoding="utf-8") as file:
        json.dump(truth, file, indent=1)
    return name


def generate(seed_name, count, out, jobs):
    work = [(seed_name, card, out) for card in deck(seed_name, count)]
    with multiprocessing.Pool(jobs) as pool:
        return list(pool.imap(write_case, work, chunksize=1))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seed", choices=sorted(SEEDS), required=True)
    parser.add_argument("--cases", type=int, required=True)
    parser.add_argument("--out", required=True)
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    options = parser.parse_args()
    start = time.monotonic()
    names = generate(options.seed, options.cases, options.out, options.jobs)
    print("%d cases in %s, %.0f s" % (len(names), options.out, time.monotonic() - start), file=sys.stderr)


if __name__ == "__main__":
    main()
