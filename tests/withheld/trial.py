"""One case through the command line alone: identify, diagnose, simulate. Knows records, never truths."""
import csv
import json
import os
import resource
import subprocess
import time

import numpy as np

TIMEOUT_S = {"identify": 120, "diagnose": 180, "simulate": 60}


def read_csv(path):
    with open(path, encoding="utf-8") as file:
        names = file.readline().strip().split(",")
    values = np.loadtxt(path, delimiter=",", skiprows=1, ndmin=2)
    return {name: values[:, k] for k, name in enumerate(names)}


class Failed(Exception):
    pass


def call(hyst, verb, *arguments):
    """(stdout, seconds); a crash, a refusal or a hang is Failed, with the tool's own words."""
    start = time.monotonic()
    try:
        done = subprocess.run([hyst, verb, *arguments], capture_output=True, text=True, timeout=TIMEOUT_S[verb],
                              check=False)
    except subprocess.TimeoutExpired as hung:
        raise Failed("%s: no answer in %d s" % (verb, TIMEOUT_S[verb])) from hung
    if done.returncode != 0:
        words = done.stderr.strip().splitlines()
        raise Failed("%s: exit %d: %s" % (verb, done.returncode, words[-1] if words else "silent"))
    return done.stdout, time.monotonic() - start


def prediction(hyst, model, record, out, options):
    call(hyst, "simulate", model, record, "-o", out, "--quiet", *options)
    return read_csv(out)["output"]


def write_planned(test, path):
    """The unseen record without its output: the work that is planned, whose shrink is to be foretold."""
    with open(test, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    kept = [k for k, name in enumerate(rows[0]) if name != "output"]
    with open(path, "w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows([row[k] for k in kept] for row in rows)


def run_trial(hyst, folder, work, options=()):
    """Everything the scoreboard needs of one case folder; `options` go to every verb (a sample rate, columns)."""
    os.makedirs(work, exist_ok=True)
    model, richer = os.path.join(work, "model.json"), os.path.join(work, "augmented.json")
    calibration, record, test = (os.path.join(folder, name + ".csv") for name in ("calibration", "record", "test"))
    planned = os.path.join(work, "planned.csv")
    write_planned(test, planned)
    out = {"error": None}
    try:
        fit, out["identify_s"] = call(hyst, "identify", calibration, "-o", model, "--json", "--quiet", *options)
        out["identified"] = json.loads(fit)["relative"]
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        text, out["diagnose_s"] = call(hyst, "diagnose", model, record, "--json", "--quiet", "--calibration",
                                       calibration, "--test", planned, "-o", richer, *options)
        out["diagnose_cpu_s"] = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        with open(os.path.join(work, "diagnosis.json"), "w", encoding="utf-8") as file:
            file.write(text)
        out["diagnosis"] = json.loads(text)
        check_diagnosis(out["diagnosis"])
        plain = prediction(hyst, model, test, os.path.join(work, "plain.csv"), options)
        grown = prediction(hyst, richer, test, os.path.join(work, "grown.csv"), options)
        measured = read_csv(test)["output"]
        out["test_before"] = float(np.sqrt(np.mean((measured - plain) ** 2)))
        out["test_after"] = float(np.sqrt(np.mean((measured - grown) ** 2)))
        if not np.isfinite(out["test_after"]):
            raise Failed("simulate: the augmented model's output is not finite")
    except (Failed, ValueError, KeyError, TypeError) as failure:
        out["error"] = str(failure) or type(failure).__name__
    return out


def check_diagnosis(answer):
    """The fields of the contract that the scoreboard rests on; a KeyError or a Failed otherwise."""
    total = sum(cause["probability"] for cause in answer["causes"])
    if not 0.0 <= total <= 1.0 + 1e-6:
        raise Failed("diagnose: the causes' probabilities sum to %g" % total)
    verdict = answer["verdict"]
    if not isinstance(verdict["confident"], bool) or not isinstance(verdict["indistinguishable"], list):
        raise Failed("diagnose: verdict.confident or verdict.indistinguishable is of the wrong type")
    for region in answer["where"]:
        if not 0.0 <= region["share"] <= 1.0 + 1e-6:
            raise Failed("diagnose: a region's share is %g" % region["share"])
