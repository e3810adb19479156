"""The true share of the effect's energy in a region that `hyst diagnose` named, from the generator's own signal."""
import numpy as np


def _directions(u):
    move = np.diff(u, prepend=u[0])
    return np.where(np.abs(move) <= 1e-9 * np.ptp(u), 0.0, np.sign(move))


def _reversals(u):
    """For each sample: how many samples ago the input last turned, and how many turns are still remembered."""
    since, depth, last, way = np.empty(len(u)), np.empty(len(u)), 0, 0
    turns = [u[0]]
    for k, sense in enumerate(_directions(u)):
        if sense != 0 and way not in (0, sense):
            turns.append(u[k - 1])
            last = k - 1
        way = sense or way
        # A turn is forgotten, with its partner, once the input passes the one before it (wiping out).
        while len(turns) > 2 and way * (u[k] - turns[-2]) >= 0:
            del turns[-2:]
        since[k], depth[k] = k - last, len(turns) - 1
    return since, depth


def _axis(name, record):
    time, u = record["time"], record["input"]
    if name in record:
        return record[name]
    if name == "rate":
        return np.abs(np.gradient(u, time))
    since, depth = _reversals(u)
    if name == "depth":
        return depth
    if name == "since_reversal":
        return time - time[(np.arange(len(u)) - since).astype(int)]
    return None


def _even(time, values):
    """The values on an even grid of the median step, at most twice as many, and that grid's step."""
    duration = time[-1] - time[0]
    intervals = min(round(duration / np.median(np.diff(time))), 2 * len(time))
    return np.interp(np.linspace(time[0], time[-1], intervals + 1), time, values), duration / intervals


def _band_share(region, time, effect):
    """The share of the spectrum's energy, both signs of the frequency together, on an even grid."""
    even, step = _even(time, effect)
    lines = np.abs(np.fft.rfft(even)) ** 2
    lines[1:(len(even) + 1) // 2] *= 2.0
    hertz = np.fft.rfftfreq(len(even), step)
    inside = (hertz >= region["from"]) & (hertz <= region["to"])
    return float(lines[inside].sum() / lines.sum())


def true_share(region, record, effect):
    """The share of the effect's energy in the region; None for an axis unknown here."""
    energy = effect ** 2
    if energy.sum() == 0.0:
        return None
    if region["axis"] == "frequency":
        return _band_share(region, record["time"], effect)
    if region["axis"] == "direction":
        value = {"ascending": 1.0, "descending": -1.0, "holding": 0.0}[region["value"]]
        return float(energy[_directions(record["input"]) == value].sum() / energy.sum())
    axis = _axis(region["axis"], record)
    if axis is None:
        return None
    inside = (axis >= region["from"]) & (axis <= region["to"])
    return float(energy[inside].sum() / energy.sum())
