"""Commands in [0, 1]: what a user drives the plant with. Lengths are in samples; a `pace` is one cycle's length."""
import numpy as np


def _span(rng, least=0.3):
    low = rng.uniform(0.0, 1.0 - least)
    return low, rng.uniform(low + least, 1.0)


def _polyline(points, lengths):
    knots = np.concatenate([[0], np.cumsum(lengths)])
    return np.interp(np.arange(knots[-1]), knots, points)


def _edged(level, edge=6):
    """Steps as a generator gives them: each is a ramp of `edge` samples."""
    total = np.cumsum(np.concatenate([np.full(edge, level[0]), level]))
    return (total[edge:] - total[:-edge]) / edge


def ramps(rng, n, pace):
    low, high = _span(rng)
    count = int(np.ceil(2.0 * n / pace)) + 2
    ends = np.where(np.arange(count + 1) % 2, high, low) - rng.uniform(0, 0.3, count + 1) * (high - low) * 0.7
    return _polyline(np.clip(ends, 0, 1), rng.integers(int(0.3 * pace), int(pace), count))[:n]


def sine(rng, n, pace):
    low, high = _span(rng)
    return 0.5 * (low + high) - 0.5 * (high - low) * np.cos(2 * np.pi * np.arange(n) / (pace * rng.uniform(0.6, 1.5)))


def sweep(rng, n, pace):
    low, high = _span(rng)
    slow, fast = 1.0 / (1.5 * pace), rng.uniform(2.0, 4.0) / pace
    k = np.arange(n)
    phase = slow * n / np.log(fast / slow) * ((fast / slow) ** (k / n) - 1.0)
    return 0.5 * (low + high) - 0.5 * (high - low) * np.cos(2 * np.pi * phase)


def steps(rng, n, pace):
    holds = rng.integers(int(0.3 * pace), int(1.2 * pace), int(n / (0.3 * pace)) + 2)
    return _edged(np.repeat(rng.uniform(0.05, 0.95, len(holds)), holds)[:n])


def multisine(rng, n, pace):
    low, high = _span(rng, 0.4)
    tones = rng.uniform(0.5, 3.0, int(rng.integers(3, 7))) / pace
    k = np.arange(n)
    wave = sum(np.sin(2 * np.pi * (tone * k + rng.uniform())) / np.sqrt(tone * pace) for tone in tones)
    return low + (high - low) * (wave - wave.min()) / (wave.max() - wave.min())


def reversals(rng, n, pace):
    count = int(6 * n / pace) + 4
    ends = rng.uniform(0, 1, count + 1)
    speed = 2.0 / pace * np.exp(rng.uniform(-0.8, 0.8, count))
    return _polyline(ends, np.maximum(4, (np.abs(np.diff(ends)) / speed).astype(int)))[:n]


def scan(rng, n, pace):
    line, stroke = max(16, int(pace * rng.uniform(0.3, 0.6))), rng.uniform(0.25, 0.5)
    k = np.arange(n)
    fast = stroke * (1.0 - np.abs((k % line) / (0.5 * line) - 1.0))
    rows = np.floor(k / line) / max(1.0, np.ceil(n / line))
    return fast + (1.0 - stroke) * rows


def staircase_hold(rng, n, _pace):
    """One move, then a hold to the record's end."""
    start, end = rng.uniform(0.0, 0.2), rng.uniform(0.6, 0.95)
    return np.interp(np.arange(n), [0, 0.1 * n, 0.14 * n], [start, start, end])


def equal_steps(rng, n, pace):
    """One step size, one hold length, up and down."""
    low, high = _span(rng, 0.4)
    level = np.where((np.arange(n) // int(pace)) % 2, high, low)
    return _edged(level)


def triangle(rng, n, pace):
    low, high = _span(rng, 0.5)
    return low + (high - low) * (1.0 - np.abs((np.arange(n) % int(pace)) / (0.5 * int(pace)) - 1.0))


MIXED = {f.__name__: f for f in (ramps, sine, sweep, steps, multisine, reversals, scan)}
SINGLE = {f.__name__: f for f in (sine, staircase_hold, equal_steps, triangle)}


def join(parts, pace):
    """Parts one after another, with moves between them at a speed of one range in 0.3 cycles."""
    out = [parts[0]]
    for part in parts[1:]:
        move = 4 + int(0.3 * pace * abs(part[0] - out[-1][-1]))
        out.append(np.linspace(out[-1][-1], part[0], move, endpoint=False)[1:])
        out.append(part)
    return np.concatenate(out)


def mixed(rng, n, pace, kinds, calm_start=False):
    """A working record of n samples: every kind once, in random order; `calm_start` keeps the first half in mid range."""
    order = list(rng.permutation(kinds))
    share = rng.uniform(0.7, 1.3, len(order))
    lengths = (share / share.sum() * n).astype(int) + 1
    parts = [MIXED[kind](rng, length, pace) for kind, length in zip(order, lengths)]
    if calm_start:
        half = len(parts) // 2
        parts[:half] = [0.35 + 0.3 * part for part in parts[:half]]
        parts.insert(half, np.interp(np.arange(int(0.6 * pace)), [0, 0.15 * pace, 0.45 * pace], [0.5, 0, 1]))
    else:
        parts.insert(0, np.linspace(0.0, rng.uniform(0.2, 0.9), int(0.3 * pace)))
    out = join(parts, pace)
    while len(out) < n:
        out = join([out, MIXED[str(rng.choice(kinds))](rng, n - len(out) + 2, pace)], pace)
    return np.clip(out[:n], 0.0, 1.0)


def calibration(rng, n):
    """The slow bench record: major loops, loops at several levels, random reversals, over the whole range."""
    ends = [0.0, 1.0, 0.0, 1.0]
    for amplitude in np.linspace(0.9, 0.1, 7):
        ends += [0.5 - 0.5 * amplitude, 0.5 + 0.5 * amplitude]
    ends += [0.0, 1.0] + list(rng.uniform(0, 1, 14)) + [1.0, 0.0]
    lengths = np.abs(np.diff(ends)) + 1e-3
    return _polyline(ends, np.maximum(4, (lengths / lengths.sum() * n).astype(int)))
