"""What a diagnosis says beside what is true of the case: one flat row, from which everything on the scoreboard is counted."""
import json
import os

import numpy as np

from trial import read_csv
from where import true_share

# A gap counts as closable where the unaugmented model's error is at least this much above what a perfect effect model
# would leave; below it the share closed is a ratio of two small differences.
CLOSABLE_FROM = 1.5


def _same(effects, truth):
    return sorted(effects) == sorted(truth)


def judge(result, truth):
    """Right, in the set, confident and wrong, and the probability given to the verdict."""
    row = {"error": result["error"], "truth": truth["effects"]}
    if "diagnosis" not in result:
        row.update(verdict=None, right=False, in_set=False, confident=False, confident_wrong=False, set_size=1)
        return row
    verdict, causes = result["diagnosis"]["verdict"], result["diagnosis"]["causes"]
    others = verdict["indistinguishable"]
    row["verdict"] = list(verdict["effects"])
    row["right"] = _same(verdict["effects"], truth["effects"])
    row["in_set"] = row["right"] or any(_same(other, truth["effects"]) for other in others)
    row["set_size"] = 1 + len(others)
    row["confident"] = verdict["confident"]
    row["confident_wrong"] = verdict["confident"] and not row["in_set"]
    own = [cause for cause in causes if _same(cause["effects"], verdict["effects"])]
    row["probability"] = own[0]["probability"] if own else None
    if own and own[0].get("transferable", True) and verdict["effects"] not in ([], ["unknown"]):
        row["predicted"] = [own[0][key] for key in ("shrink", "shrink_low", "shrink_high")]
        row["predicted_planned"] = result["diagnosis"]["test"]["predicted_shrink"]
    row["advice"] = verdict.get("advice", "")
    return row


def measure(result, truth, folder, sealed, work):
    """Shrink on the unseen record, share closed, and the where-error."""
    row = {key: result.get(key) for key in ("identify_s", "diagnose_s", "diagnose_cpu_s", "identified", "test_before",
                                            "test_after")}
    if result.get("test_after") is None:
        return row
    test, effect = read_csv(os.path.join(folder, "test.csv")), np.loadtxt(os.path.join(sealed, "test_effect.txt"))
    plain = read_csv(os.path.join(work, "plain.csv"))["output"]
    floor = float(np.sqrt(np.mean((test["output"] - effect - plain) ** 2)))
    before, after = result["test_before"], result["test_after"]
    row["test_floor"] = floor
    row["realised"] = 1.0 - after / before
    if truth["transferable"] and before >= CLOSABLE_FROM * floor:
        row["closed"] = (before - after) / (before - floor)
    regions = result["diagnosis"]["where"]
    if regions and truth["effects"]:
        record = read_csv(os.path.join(folder, "record.csv"))
        effect = np.loadtxt(os.path.join(sealed, "record_effect.txt"))
        share = true_share(regions[0], record, effect)
        row["where_error"] = None if share is None else abs(share - regions[0]["share"])
    return row


def row_of(result, folder, sealed, work):
    with open(os.path.join(sealed, "truth.json"), encoding="utf-8") as file:
        truth = json.load(file)
    row = {key: truth[key] for key in ("kind", "work", "body", "samples", "coloured", "doubts", "transferable", "physics",
                                       "mechanisms")}
    row["size"] = min(truth["sizes_reached"], default=0.0)
    row.update(judge(result, truth))
    row.update(measure(result, truth, folder, sealed, work))
    return row
