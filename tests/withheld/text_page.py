"""The scoreboard as plain text."""


def figure(line):
    """A figure as people read it: a rate with its count, or a number."""
    if line["value"] is None:
        return "no case"
    if "count" in line and line["of"]:
        return "%.3f (%d/%d)" % (line["value"], line["count"], line["of"])
    return "%.4g" % line["value"]


def held(line):
    return {True: "ok", False: "missed, open" if line["open"] else "MISSED", None: "-"}[line["holds"]]


def _limits(board):
    rows = ["%-82s %-18s %-8s %s" % ("figure", "reached", "limit", "")]
    for line in board["limits"]:
        sign = ">=" if line["sense"] == "min" else "<="
        rows.append("%-82s %-18s %s %-5.3g %s" % (line["text"], figure(line), sign, line["limit"], held(line)))
    return rows


def _bodies(board):
    rows = ["", "%-15s %6s %10s %16s %16s %18s %14s %14s %8s" % (
        "body", "cases", "misfit", "right, >= 3x", "in the set", "confident, wrong", "false alarms", "strangers", "closed")]
    for name, body in board["bodies"].items():
        keys = ("misfit", "right", "in_set", "confident_wrong", "false_alarms", "strangers", "closed")
        rows.append("%-15s %6d %10s %16s %16s %18s %14s %14s %8s" % (name, body["cases"], *(figure(body[k]) for k in keys)))
    return rows


def _detection(board):
    rows = ["", "half right from this size on (x noise RMS)"]
    for name, found in board["detection"].items():
        size = "never" if found["threshold"] is None else "%.2f" % found["threshold"]
        rows.append("  %-22s %6s   %d of %d right" % (name, size, found["right"], found["cases"]))
    return rows


def _confusion(board):
    rows = ["", "truth -> verdict (single effects from 1 x noise up, none, outside the catalogue)"]
    for truth, said in sorted(board["confusion"].items()):
        words = ", ".join("%s %d" % pair for pair in sorted(said.items(), key=lambda item: -item[1]))
        rows.append("  %-22s %s" % (truth, words))
    return rows


def _measured(board):
    rows = ["", "measured records"] if board["measured"] else []
    for row in board["measured"]:
        said = row["error"] or "%s, indistinguishable %s" % (row["verdict"], row.get("indistinguishable"))
        rows.append("  %-18s %-7s %s" % (row["name"], "in set" if row["in_set"] else "MISSED", said))
        rows.append("  %-18s         known: %s" % ("", row["known"]))
    return rows


def text(board):
    curve = ["", "probability given -> share right: " + ", ".join(
        "%.2f -> %.2f (%d)" % (c["probability"], c["right"], c["count"]) for c in board["calibration_curve"])]
    head = ["%s, %d cases" % (board["command"], board["cases"]), ""]
    return "\n".join(head + _limits(board) + _bodies(board) + _detection(board) + curve + _confusion(board)
                     + _measured(board)) + "\n"
