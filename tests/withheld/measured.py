"""Measured records with the cause withheld: case folders cut from ../shared/data, with what is known of each."""
import json
import os

import numpy as np

from trial import read_csv


def _write(folder, part, columns):
    np.savetxt(os.path.join(folder, part + ".csv"), np.column_stack(list(columns.values())), fmt="%.9g", delimiter=",",
               header=",".join(columns), comments="")


def _joined(folder, names):
    """Several records one after another, half a second apart."""
    parts, start = [], 0.0
    for name in names:
        part = read_csv(os.path.join(folder, name))
        part["time"] = part["time"] - part["time"][0] + start
        start = part["time"][-1] + 0.5
        parts.append(part)
    return {key: np.concatenate([part[key] for part in parts]) for key in parts[0]}


def _with_decoy(columns, seed):
    """A staircase like the pressure's, one level a record, in an order of its own: it explains nothing."""
    pressure = columns["pressure"]
    rng = np.random.default_rng(seed)
    record = np.cumsum(np.abs(np.diff(pressure, prepend=pressure[0])) > 0.5)
    levels = rng.permutation(np.linspace(20.0, 30.0, record[-1] + 1))
    return {**columns, "temperature": levels[record] + 0.05 * rng.standard_normal(len(record))}


def _piston(data, shape, pressures, rest):
    folder = os.path.join(data, "pneumatic_piston")

    def pick(levels):
        return ["%s_%dbar.csv" % (shape, level) for level in levels]

    return {"calibration": _with_decoy(_joined(folder, pick([rest])), 1),
            "record": _with_decoy(_joined(folder, pick(pressures[0])), 2),
            "test": _with_decoy(_joined(folder, pick(pressures[1])), 3)}


def _cut(columns, first, last):
    keep = (columns["time"] >= first) & (columns["time"] < last)
    return {key: columns[key][keep] for key in ("time", "input", "output")}


def _piezo_varied(data):
    folder = os.path.join(data, "piezo_stack")
    varied = read_csv(os.path.join(folder, "varied.csv"))
    middle = 0.5 * varied["time"][-1]
    return {"calibration": _cut(read_csv(os.path.join(folder, "loop_1hz.csv")), 0.0, 1e9),
            "record": _cut(varied, 0.0, middle), "test": _cut(varied, middle, 1e9)}


def _piezo_late_loops(data):
    loop = read_csv(os.path.join(data, "piezo_stack", "loop_1hz.csv"))
    return {"calibration": _cut(loop, 0.0, 5.0), "record": _cut(loop, 0.0, 40.0), "test": _cut(loop, 5.0, 40.0)}


def _loop(data, name, turns):
    """A quasi-static loop run `turns` times, from its foot, given one second a turn."""
    one = read_csv(os.path.join(data, "magnetic_loops", name))
    foot = int(np.argmin(one["input"]))
    order = np.tile(np.roll(np.arange(len(one["input"])), -foot), turns)
    # Where the loop closes on itself a point comes twice; time goes on.
    return {"time": np.arange(len(order)) / len(one["input"]), "input": one["input"][order],
            "output": one["output"][order]}


def _magnetic(data, small, large):
    return {"calibration": _loop(data, small, 4), "record": _loop(data, large, 8), "test": _loop(data, large, 4)}


BEYOND = [["unknown"], ["output_saturation"], ["output_nonlinearity"], ["noncongruency"]]
# name: how it is made, the sets of causes that are right, what is known
RECORDS = {
    "piston_circle": (lambda d: _piston(d, "circle", ([1, 5, 3, 7], [2, 6, 4]), 3), [["exogenous:pressure"]],
                      "loop's centre and width follow the measured pressure; temperature is a decoy"),
    "piston_kidney": (lambda d: _piston(d, "kidney", ([2, 6, 4, 1, 7], [3, 5]), 4), [["exogenous:pressure"]],
                      "loop's centre and width follow the measured pressure; temperature is a decoy"),
    "piezo_varied": (_piezo_varied, [["delay"]],
                     "the output answers two samples late, which one 1 Hz loop hides; ceramics creep in the holds"),
    "piezo_late_loops": (_piezo_late_loops, [["creep"], ["drift"]],
                         "the cycle mean creeps by 0.6 um in 40 cycles, 1 % of the range"),
    "ferrite_beyond": (lambda d: _magnetic(d, "mnzn_2.csv", "mnzn_4.csv"), BEYOND,
                       "amplitude five times the calibration's: saturation the model has not seen"),
    "steel_beyond": (lambda d: _magnetic(d, "m130_27s_2.csv", "m130_27s_3.csv"), BEYOND,
                     "amplitude three times the calibration's: saturation the model has not seen"),
}


def write(data, out):
    """Writes the case folders and, sealed apart, what is known; returns the names."""
    for name, (make, right, known) in RECORDS.items():
        folder = os.path.join(out, "measured", name)
        sealed = os.path.join(out, "sealed_measured")
        os.makedirs(folder, exist_ok=True)
        os.makedirs(sealed, exist_ok=True)
        for part, columns in make(data).items():
            _write(folder, part, columns)
        with open(os.path.join(sealed, name + ".json"), "w", encoding="utf-8") as file:
            json.dump({"right": right, "known": known}, file)
    return list(RECORDS)


def judge(name, result, out):
    """Right when the verdict, or a set it calls indistinguishable, holds a known cause: a machine may have others too."""
    with open(os.path.join(out, "sealed_measured", name + ".json"), encoding="utf-8") as file:
        truth = json.load(file)
    row = {"name": name, "known": truth["known"], "right_sets": truth["right"], "error": result["error"],
           "verdict": None, "in_set": False, "first": False}
    if "diagnosis" not in result:
        return row
    verdict = result["diagnosis"]["verdict"]

    def fits(effects):
        return any([effect] in truth["right"] for effect in effects)

    row["verdict"] = verdict["effects"]
    row["indistinguishable"] = verdict["indistinguishable"]
    row["confident"] = verdict["confident"]
    row["first"] = fits(verdict["effects"])
    row["in_set"] = row["first"] or any(fits(other) for other in verdict["indistinguishable"])
    row["gap"] = result["diagnosis"]["gap"]
    for key in ("diagnose_s", "test_before", "test_after"):
        row[key] = result.get(key)
    return row
