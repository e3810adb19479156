"""The scoreboard as one self-contained HTML page."""
import html
import io

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402  the backend comes first
import numpy as np  # noqa: E402

from effects import CATALOGUE  # noqa: E402
from text_page import figure, held  # noqa: E402

STYLE = """:root{color-scheme:light dark}body{font:15px/1.5 system-ui,sans-serif;max-width:70rem;margin:2rem auto;padding:0 1rem}
table{border-collapse:collapse}td,th{padding:.15rem .6rem;text-align:left;border-bottom:1px solid #8884}
.MISSED{color:#c22;font-weight:600}.ok{color:#182}svg{max-width:100%;height:auto;background:#fff;border-radius:6px}"""
matplotlib.rcParams.update({"svg.hashsalt": "hyst", "font.size": 9, "axes.spines.top": False, "axes.spines.right": False})


def _svg(drawing):
    file = io.StringIO()
    drawing.tight_layout()
    drawing.savefig(file, format="svg", metadata={"Date": None})
    plt.close(drawing)
    return file.getvalue()[file.getvalue().index("<svg"):]


def _confusion(board):
    rows = [*CATALOGUE, "none", "unknown"]
    columns = [*rows, "two or more", "no answer"]
    counts = np.array([[board["confusion"].get(r, {}).get(c, 0) for c in columns] for r in rows])
    share = counts / np.maximum(1, counts.sum(axis=1, keepdims=True))
    drawing, axis = plt.subplots(figsize=(10, 8))
    axis.imshow(share, cmap="Blues", vmin=0, vmax=1)
    for i, j in zip(*np.nonzero(counts)):
        axis.text(j, i, counts[i, j], ha="center", va="center", color="white" if share[i, j] > 0.6 else "black")
    axis.set_xticks(range(len(columns)), columns, rotation=60, ha="right")
    axis.set_yticks(range(len(rows)), rows)
    axis.set_xlabel("verdict")
    axis.set_ylabel("truth")
    return _svg(drawing)


def _by_size(rows):
    edges = np.geomspace(0.5, 50.0, 7)
    drawing, axis = plt.subplots(figsize=(7, 3.6))
    for key, name in (("right", "first place"), ("in_set", "in the set"), ("confident_wrong", "confident and wrong")):
        points = []
        for low, high in zip(edges, edges[1:]):
            inside = [r[key] for r in rows if r["kind"] == "single" and low <= r["size"] < high]
            if inside:
                points.append((np.sqrt(low * high), np.mean(inside), len(inside)))
        if points:
            axis.plot(*zip(*[p[:2] for p in points]), "o-", label=name)
    axis.set_xscale("log")
    axis.set_ylim(-0.03, 1.03)
    axis.set_xlabel("size of the effect, x noise RMS")
    axis.set_ylabel("share of single-effect cases")
    axis.legend()
    return _svg(drawing)


def _detection(board):
    names = list(board["detection"])
    sizes = [board["detection"][n]["threshold"] for n in names]
    drawing, axis = plt.subplots(figsize=(7, 4.2))
    axis.barh(names, [s if s is not None else 50.0 for s in sizes],
              color=["#4a7ebb" if s is not None else "#cccccc" for s in sizes])
    axis.axvline(1.0, color="black", lw=0.8)
    axis.set_xscale("log")
    axis.invert_yaxis()
    axis.set_xlabel("size at which half are right, x noise RMS (grey: never)")
    return _svg(drawing)


def _calibration(board):
    drawing, axis = plt.subplots(figsize=(4.2, 4.2))
    axis.plot([0, 1], [0, 1], color="grey", lw=0.8)
    for c in board["calibration_curve"]:
        axis.plot(c["probability"], c["right"], "o", color="#4a7ebb", ms=4 + np.sqrt(c["count"]))
    axis.set_xlabel("probability given to the verdict")
    axis.set_ylabel("share right")
    return _svg(drawing)


def _shrink(rows):
    told = [r for r in rows if r.get("predicted") and r.get("realised") is not None and r["transferable"]]
    drawing, axis = plt.subplots(figsize=(4.6, 4.2))
    axis.plot([-0.2, 1], [-0.2, 1], color="grey", lw=0.8)
    for right, colour in ((True, "#4a7ebb"), (False, "#cc3333")):
        own = [r for r in told if r["right"] == right]
        if own:
            p = np.array([r["predicted"] for r in own])
            axis.errorbar(p[:, 0], [r["realised"] for r in own], fmt="o", ms=3, color=colour, lw=0.6,
                          xerr=np.maximum(0, [p[:, 0] - p[:, 1], p[:, 2] - p[:, 0]]),
                          label="verdict right" if right else "verdict wrong")
    axis.set_xlabel("predicted shrink, 90 % interval")
    axis.set_ylabel("realised on the unseen record")
    axis.set_ylim(-0.2, 1.02)
    if told:
        axis.legend()
    return _svg(drawing)


def _table(head, rows):
    cells = "".join("<tr>%s</tr>" % "".join(
        "<td class='%s'>%s</td>" % (html.escape(str(c)) if c in ("MISSED", "ok") else "", html.escape(str(c)))
        for c in row) for row in rows)
    return "<table><tr>%s</tr>%s</table>" % ("".join("<th>%s</th>" % html.escape(h) for h in head), cells)


def page(board, rows):
    sign = {"min": "≥", "max": "≤"}
    limits = _table(("figure", "reached", "limit", ""), [
        (x["text"], figure(x), "%s %.3g" % (sign[x["sense"]], x["limit"]), held(x)) for x in board["limits"]])
    keys = ("misfit", "right", "in_set", "confident_wrong", "false_alarms", "strangers", "closed")
    bodies = _table(("body", "cases", "calibration misfit", "right, from 3 ×", "in the set", "confident, wrong",
                     "false alarms", "strangers", "closed"),
                    [(n, b["cases"], *(figure(b[k]) for k in keys)) for n, b in board["bodies"].items()])
    measured = _table(("record", "known", "verdict", "indistinguishable", ""), [
        (m["name"], m["known"], m["error"] or m["verdict"], m.get("indistinguishable", ""),
         "ok" if m["in_set"] else "MISSED") for m in board["measured"]])
    parts = [("Limits", limits), ("Bodies", bodies), ("Measured records", measured),
             ("Confusion", _confusion(board)), ("Accuracy against size", _by_size(rows)),
             ("Detection threshold", _detection(board)), ("Calibration of the probabilities", _calibration(board)),
             ("Shrink, predicted and realised", _shrink(rows))]
    body = "".join("<h2>%s</h2>%s" % part for part in parts)
    return ("<!doctype html><html lang='en'><meta charset='utf-8'><title>Withheld causes</title><style>%s</style>"
            "<h1>Diagnosis on withheld causes</h1><p><code>%s</code>, %d cases</p>%s</html>"
            % (STYLE, html.escape(board["command"]), board["cases"], body))
