"""Counts the rows into figures and holds the figures against the limits."""
import math

import numpy as np

from effects import CATALOGUE
from thresholds import LARGE, LIMITS, OPEN, SMALL_DRAW_BELOW, SMALL_DRAW_TAIL, THIRD


def _rate(rows, key):
    """(value, count, of how many); None where there is nothing to count."""
    return {"value": sum(bool(r[key]) for r in rows) / len(rows) if rows else None,
            "count": sum(bool(r[key]) for r in rows), "of": len(rows)}


def _median(values):
    values = [v for v in values if v is not None]
    return {"value": float(np.median(values)) if values else None, "of": len(values), "values": values}


def _shown(figure):
    return {name: value for name, value in figure.items() if name != "values"}


def _is_hard(row):
    return row["kind"] == "pair" or row["size"] < LARGE or row["coloured"] or row["samples"] < 3000


def classes(rows):
    """The groups the limits speak of."""
    mixed = [r for r in rows if r["kind"] in ("single", "pair")]
    visible = [r for r in mixed if r["size"] >= THIRD]
    plays = [r for r in visible if r["body"] == "plays"]
    others = [r for r in visible if r["body"] != "plays"]
    return {"plays": plays, "plays_single": [r for r in plays if r["kind"] == "single"],
            "others": others, "hard": [r for r in others if _is_hard(r)],
            "easy": [r for r in others if not _is_hard(r)],
            "none": [r for r in rows if r["kind"] == "none"],
            "strangers": [r for r in rows if r["kind"] == "stranger"],
            "one_kind": [r for r in rows if r["kind"] == "one_kind"], "visible": visible}


def naming(rows):
    c = classes(rows)
    answered = [dict(r, ok=not r["error"]) for r in rows]
    alarms = [dict(r, alarm=bool(r["verdict"])) for r in c["none"]]
    sizes = [r["set_size"] for r in c["plays"]]
    return {
        "answered": _rate(answered, "ok"),
        "plays_large": _rate([r for r in c["plays_single"] if r["size"] >= LARGE], "right"),
        "plays_third": _rate([r for r in c["plays_single"] if r["size"] < LARGE], "right"),
        "plays_pairs": _rate([r for r in c["plays"] if r["kind"] == "pair"], "right"),
        "plays_confident_wrong": _rate(c["plays"], "confident_wrong"),
        "plays_set_size": {"value": float(np.mean(sizes)) if sizes else None, "of": len(sizes)},
        "bodies_large": _rate(c["easy"], "right"),
        "bodies_confident_wrong": _rate(c["easy"], "confident_wrong"),
        "hard": _rate(c["hard"], "right"),
        "hard_confident_wrong": _rate(c["hard"], "confident_wrong"),
        "false_alarms": _rate(alarms, "alarm"),
        "strangers": _rate(c["strangers"], "right"),
        "one_kind_in_set": _rate(c["one_kind"], "in_set"),
        "one_kind_confident_wrong": _rate(c["one_kind"], "confident_wrong"),
    }


def distances(rows):
    """Figures about how far, where and how long."""
    visible = classes(rows)["visible"]
    # Whether the forecast of a wrong verdict came true is part of the question; only what cannot carry over is left out.
    told = [dict(r, miss=abs(r["predicted"][0] - r["realised"]),
                 miss_planned=abs(r["predicted_planned"] - r["realised"]),
                 covered=r["predicted"][1] <= r["realised"] <= r["predicted"][2])
            for r in visible if r.get("predicted") and r.get("realised") is not None and r["transferable"]]
    plays, others = ([r for r in visible if (r["body"] == "plays") == own] for own in (True, False))
    worse = [dict(r, worse=r["test_after"] > 1.02 * r["test_before"]) for r in rows
             if r.get("test_after") is not None and r["transferable"]]
    return {
        "plays_shrink_error": _median([r["miss"] for r in told if r["body"] == "plays"]),
        "bodies_shrink_error": _median([r["miss"] for r in told if r["body"] != "plays"]),
        "plays_planned_error": _median([r["miss_planned"] for r in told if r["body"] == "plays"]),
        "bodies_planned_error": _median([r["miss_planned"] for r in told if r["body"] != "plays"]),
        "shrink_covered": _rate(told, "covered"),
        "plays_closed": _median([r.get("closed") for r in plays]),
        "bodies_closed": _median([r.get("closed") for r in others]),
        "made_worse": _rate(worse, "worse"),
        "where_error": _median([r.get("where_error") for r in visible]),
        "diagnose_s": _median([r.get("diagnose_s") for r in rows]),
    }


def calibration_curve(rows, bins=5):
    """Per bin of the probability given to the verdict: mean probability, share right, how many."""
    said = [r for r in rows if r.get("probability") is not None and r["kind"] != "one_kind"]
    curve = []
    for k in range(bins):
        inside = [r for r in said if min(int(r["probability"] * bins), bins - 1) == k]
        if inside:
            curve.append({"probability": float(np.mean([r["probability"] for r in inside])),
                          "right": float(np.mean([r["right"] for r in inside])), "count": len(inside)})
    total = sum(c["count"] for c in curve)
    error = sum(c["count"] * abs(c["probability"] - c["right"]) for c in curve) / total if total else None
    return curve, {"value": error, "of": total}


def rising_fit(values):
    """The non-decreasing sequence nearest to the values (pool adjacent violators)."""
    pools = []
    for value in values:
        pools.append([float(value), 1])
        while len(pools) > 1 and pools[-2][0] > pools[-1][0]:
            last, count = pools.pop()
            before, many = pools[-1]
            pools[-1] = [(before * many + last * count) / (many + count), many + count]
    return [mean for mean, count in pools for _ in range(count)]


def detection(rows):
    """Per effect: the size from which a rising curve through right and wrong is at one half; None if never."""
    out = {}
    for name in CATALOGUE:
        own = sorted((r["size"], r["right"]) for r in rows
                     if r["kind"] == "single" and r["truth"][0].split(":")[0] == name)
        curve = rising_fit([right for _, right in own])
        first = next((k for k, level in enumerate(curve) if level >= 0.5), None)
        if first is None:
            size = None
        elif first == 0:
            size = own[0][0]
        else:
            size = math.sqrt(own[first - 1][0] * own[first][0])
        out[name] = {"threshold": size, "cases": len(own), "right": sum(right for _, right in own)}
    return out


def confusion(rows):
    """{truth: {verdict: count}} over single effects, none and strangers; pairs named are 'two or more'."""
    table = {}
    for row in rows:
        if row["kind"] not in ("single", "none", "stranger") or 0 < row["size"] < 1.0:
            continue
        truth = row["truth"][0].split(":")[0] if row["truth"] else "none"
        if row["verdict"] is None:
            said = "no answer"
        elif len(row["verdict"]) > 1:
            said = "two or more"
        else:
            said = row["verdict"][0].split(":")[0] if row["verdict"] else "none"
        table.setdefault(truth, {}).setdefault(said, 0)
        table[truth][said] += 1
    return table


def by_body(rows):
    out = {}
    for body in sorted({r["body"] for r in rows}):
        own = [r for r in rows if r["body"] == body]
        c = classes(own)
        out[body] = {"cases": len(own), "misfit": _shown(_median([r.get("identified") for r in own])),
                     "right": _rate(c["visible"], "right"), "in_set": _rate(c["visible"], "in_set"),
                     "confident_wrong": _rate(c["visible"], "confident_wrong"),
                     "false_alarms": naming(own)["false_alarms"], "strangers": _rate(c["strangers"], "right"),
                     "closed": _shown(_median([r.get("closed") for r in c["visible"]]))}
    return out


def _tail(count, of, limit):
    """P(at most `count` of `of`) for a success rate of `limit`."""
    return sum(math.comb(of, k) * limit ** k * (1.0 - limit) ** (of - k) for k in range(count + 1))


def holds(figure, sense, limit, small_draw):
    """True, False, or None where nothing was counted."""
    if figure["value"] is None:
        return None
    met = figure["value"] >= limit - 1e-12 if sense == "min" else figure["value"] <= limit + 1e-12
    if met or not small_draw:
        return met
    if "values" in figure:  # a tool whose true median is the limit has half of its cases on either side
        within = [v >= limit if sense == "min" else v <= limit for v in figure["values"]]
        return _tail(sum(within), len(within), 0.5) >= SMALL_DRAW_TAIL
    if "count" not in figure:
        return met
    if sense == "min":
        return _tail(figure["count"], figure["of"], limit) >= SMALL_DRAW_TAIL
    return _tail(figure["of"] - figure["count"], figure["of"], 1.0 - limit) >= SMALL_DRAW_TAIL


def scoreboard(rows, measured):
    figures = {**naming(rows), **distances(rows)}
    curve, figures["calibration_error"] = calibration_curve(rows)
    thresholds = detection(rows)
    found = [t for t in thresholds.values() if t["threshold"] is not None and t["threshold"] <= 1.0]
    figures["detected"] = {"value": len(found) / len(thresholds), "of": len(thresholds), "count": len(found)}
    figures["measured"] = _rate(measured, "in_set")
    small = len(rows) < SMALL_DRAW_BELOW
    limits = []
    for key, text, sense, limit in LIMITS:
        # With fewer than six sizes an effect, its threshold is a coin's word; and time is a benchmark's: shown, not held.
        held = None if key in ("detected", "diagnose_s") and small else holds(figures[key], sense, limit, small)
        limits.append({"key": key, "text": text, "sense": sense, "limit": limit, **_shown(figures[key]), "holds": held,
                       "open": key in OPEN})
    return {"cases": len(rows), "limits": limits, "confusion": confusion(rows), "detection": thresholds,
            "calibration_curve": curve, "bodies": by_body(rows), "measured": measured}
