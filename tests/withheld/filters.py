"""Filters for uniformly sampled signals that start at rest; times in samples."""
import math

import numpy as np


def lag(signal, time, growth=None):
    """First-order lag. `growth(x)` multiplies the time where the present output is x."""
    if time <= 1e-6:
        return np.array(signal, float)
    out, x = np.empty(len(signal)), float(signal[0])
    follow = -math.expm1(-1.0 / time)
    for k, want in enumerate(np.asarray(signal).tolist()):
        if growth is not None:
            follow = -math.expm1(-1.0 / (time * max(0.02, growth(x))))
        x += follow * (want - x)
        out[k] = x
    return out


def log_spectrum(signal, times):
    """Mean of the first-order responses with the given times."""
    follow = -np.expm1(-1.0 / np.asarray(times))
    x, out = np.zeros(len(times)), np.empty(len(signal))
    for k, want in enumerate(signal.tolist()):
        x += follow * (want - x)
        out[k] = x.sum()
    return out / len(times)


def second_order(signal, period, damping):
    """A lightly damped mode with gain 1 at rest, exact for the mean of two neighbouring samples held."""
    omega = 2.0 * math.pi / period
    decay, ring = math.exp(-damping * omega), omega * math.sqrt(1.0 - damping * damping)
    cosine, sine = math.cos(ring), math.sin(ring)
    tilt = damping * omega / ring
    a, b = decay * (cosine + tilt * sine), decay * sine / ring
    c, d = -decay * omega * omega * sine / ring, decay * (cosine - tilt * sine)
    level, speed, last, out = float(signal[0]), 0.0, float(signal[0]), np.empty(len(signal))
    for k, value in enumerate(signal.tolist()):
        push = 0.5 * (value + last)
        away = level - push
        level, speed = push + a * away + b * speed, c * away + d * speed
        out[k], last = level, value
    return out
