#!/usr/bin/env python3
"""Checks the diagnosis on the measured records alone: check_measured.py HYST DATA. The known cause must be in every
record's set, and a loop far beyond the calibration's range must be called so, never an oscillation unrelated to the
input. Exit code 77 where numpy or the records are missing."""
import os
import sys
import tempfile

try:
    import measured
    from trial import run_trial
except ImportError:
    print("skipped: no numpy (sh tests/withheld/install.sh)")
    sys.exit(77)


def faults_of(name, result, out):
    """What is wrong with one record's diagnosis, in words."""
    row = measured.judge(name, result, out)
    if row["error"]:
        return [row["error"]]
    faults = [] if row["in_set"] else ["%s and %s hold none of %s" % (row["verdict"], row["indistinguishable"],
                                                                      row["right_sets"])]
    if name.endswith("_beyond"):
        named = [effect for names in [row["verdict"], *row["indistinguishable"]] for effect in names]
        faults += ["periodic_disturbance is named"] if "periodic_disturbance" in named else []
        # Both loops reach at least three times the calibration's amplitude: a sine is beyond it for 1 - 2/pi asin(1/3).
        faults += [] if row["gap"]["beyond_calibration"] > 0.5 else ["the range is not seen to be left"]
        faults += ["confident of what was never measured"] if row["confident"] else []
    return faults


def main():
    if len(sys.argv) != 3:
        sys.exit("usage: check_measured.py HYST DATA")
    hyst, data = sys.argv[1:]
    if not os.path.isdir(data):
        print("skipped: no measured records in %s" % data)
        return 77
    missed = 0
    with tempfile.TemporaryDirectory() as out:
        for name in measured.write(data, out):
            result = run_trial(hyst, os.path.join(out, "measured", name), os.path.join(out, "work", name))
            faults = faults_of(name, result, out)
            print("%s: %s" % (name, "; ".join(faults) or "ok"), flush=True)
            missed += bool(faults)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
