"""Hysteretic bodies: four kinds of material, each run on a trajectory that already holds its prehistory.

A body maps an input in [0, 1] to `hysteretic(x)`, a rising hysteretic response, and `reversible(u)`, a rising map without
memory. Scales are arbitrary; plant.py brings the sum to [0, 1].
"""
import math

import numpy as np


def _bent(rng):
    """A smooth increasing curve from 0 to 1 that is neither a line nor a hyperbolic tangent."""
    kind, bend, centre = rng.integers(3), rng.uniform(0.8, 3.0), rng.uniform(0.35, 0.65)
    grid = np.linspace(0.0, 1.0, 801)
    if kind == 0:
        shape = np.arctan(bend * (grid - centre))
    elif kind == 1:
        shape = np.arcsinh(2.0 * bend * (grid - centre)) + 0.4 * grid
    else:
        shape = grid + 0.12 * bend * np.sin(2.0 * np.pi * (grid - 0.25 * centre)) / (2.0 * np.pi)
    shape = (shape - shape[0]) / (shape[-1] - shape[0])
    return lambda u: np.interp(u, grid, shape)


class DensePlays:
    """Hundreds of generalized plays in three families, each with its own pair of envelopes."""

    name = "plays"

    def __init__(self, rng):
        self.count = int(rng.integers(200, 400))
        self.radius = np.sort(rng.uniform(0.0, 0.45, self.count))
        humps = np.exp(-self.radius / rng.uniform(0.05, 0.3))
        humps += rng.uniform(0, 1) * np.exp(-((self.radius - rng.uniform(0.1, 0.4)) / 0.05) ** 2)
        self.weight = humps * rng.uniform(0.5, 1.5, self.count)
        self.weight /= self.weight.sum()
        self.family = rng.integers(3, size=self.count)
        self.ascending = [_bent(rng) for _ in range(3)]
        # Moved to the left of the ascending one, so that the loop runs anticlockwise whatever the radius.
        self.shifts = rng.uniform(0.0, 0.08, 3)
        self.reversible = _bent(rng)
        self.reversible_share = rng.uniform(0.15, 0.5)

    def bounds(self, x):
        low = np.stack([curve(x) for curve in self.ascending], 1)[:, self.family] - self.radius
        high = np.stack([curve(x + s) for curve, s in zip(self.ascending, self.shifts)], 1)[:, self.family]
        return low, high + self.radius

    def hysteretic(self, x, viscosity=None):
        """`viscosity`: each play's relaxation time in samples; None: the plays follow at once."""
        low, high = self.bounds(x)
        play = high[0].copy()
        out = np.empty(len(x))
        follow = None if viscosity is None else -np.expm1(-1.0 / np.maximum(viscosity, 1e-9))
        pushed = np.empty_like(play)
        for k in range(len(x)):
            np.maximum(play, low[k], out=pushed)
            np.minimum(pushed, high[k], out=pushed)
            if follow is None:
                play, pushed = pushed, play
            else:
                play += follow * (pushed - play)
            out[k] = play @ self.weight
        return out


class Preisach:
    """A field of relays with a two-hump density: exact and continuous through the field's Everett integral."""

    name = "preisach"
    LOW, HIGH, CELLS = -0.15, 1.15, 420

    def __init__(self, rng):
        axis = np.linspace(self.LOW, self.HIGH, self.CELLS + 1)
        middle = 0.5 * (axis[1:] + axis[:-1])
        up, down = np.meshgrid(middle, middle, indexing="ij")
        width, level = up - down, 0.5 * (up + down)
        field = np.zeros_like(up)
        for _ in range(2):
            coercive, spread = rng.uniform(0.05, 0.3), rng.uniform(0.06, 0.18)
            centre, smear = rng.uniform(0.35, 0.65), rng.uniform(0.15, 0.35)
            field += rng.uniform(0.4, 1.0) * np.exp(-(((width - coercive) / spread) ** 2)
                                                    - ((level - centre) / smear) ** 2)
        field[down > up] = 0.0
        # everett[i, j]: mass of the relays that switch up below axis[i] and down above axis[j].
        self.everett = np.zeros((self.CELLS + 1, self.CELLS + 1))
        mass = np.cumsum(field, axis=0)
        self.everett[1:, :-1] = np.cumsum(mass[:, ::-1], axis=1)[:, ::-1]
        self.everett /= self.everett.max()
        self.reversible = _bent(rng)
        self.reversible_share = rng.uniform(0.1, 0.4)

    def integral(self, up, down):
        scale = self.CELLS / (self.HIGH - self.LOW)
        a = np.clip((np.asarray(up) - self.LOW) * scale, 0.0, self.CELLS - 1e-9)
        b = np.clip((np.asarray(down) - self.LOW) * scale, 0.0, self.CELLS - 1e-9)
        i, j = a.astype(int), b.astype(int)
        fa, fb, table = a - i, b - j, self.everett
        return ((1 - fa) * ((1 - fb) * table[i, j] + fb * table[i, j + 1])
                + fa * ((1 - fb) * table[i + 1, j] + fb * table[i + 1, j + 1]))

    def hysteretic(self, x):
        extremes, held = [self.LOW], [0.0]
        base, turn, rising = np.empty(len(x)), np.empty(len(x)), np.empty(len(x), bool)
        last, up = self.LOW, True
        for k, value in enumerate(np.clip(x, self.LOW, self.HIGH).tolist()):
            if (value < last) if up else (value > last):
                change = float(self.integral(last, extremes[-1]) if up else self.integral(extremes[-1], last))
                held.append(held[-1] + (change if up else -change))
                extremes.append(last)
                up = not up
            while len(extremes) > 2 and ((value >= extremes[-2]) if up else (value <= extremes[-2])):
                del extremes[-2:], held[-2:]
            # A fall below the first rise's foot leads back to negative saturation.
            if not up and len(extremes) == 2 and value <= extremes[0]:
                extremes, held, up = [value], [0.0], True
            base[k], turn[k], rising[k], last = held[-1], extremes[-1], up, value
        x = np.clip(x, self.LOW, self.HIGH)
        return np.where(rising, base + self.integral(x, turn), base - self.integral(turn, x))


class BoucWen:
    """Displacement = stiffness * input - internal force of a Bouc-Wen element, as in piezoelectric stages."""

    name = "bouc_wen"

    def __init__(self, rng):
        self.order = rng.uniform(1.0, 1.6)
        self.slope = rng.uniform(4.0, 9.0)
        total, split = self.slope, rng.uniform(0.55, 0.85)
        self.beta, self.gamma = total * split, total * (1.0 - split)
        self.skew = rng.uniform(-0.15, 0.15) * total
        self.stiffness = self.slope * rng.uniform(1.15, 1.5)
        self.reversible = _bent(rng)
        self.reversible_share = rng.uniform(0.0, 0.2)

    def hysteretic(self, x):
        force, last, out = 0.0, float(x[0]), np.empty(len(x))
        for k, value in enumerate(x.tolist()):
            move = value - last
            pieces = 1 + int(abs(move) / 0.01)
            piece = move / pieces
            way = math.copysign(1.0, move)
            for _ in range(pieces):
                force += piece * self._slope(force + 0.5 * piece * self._slope(force, way), way)
            out[k], last = self.stiffness * value - force, value
        return out / self.stiffness

    def _slope(self, force, way):
        pull = self.beta * (1.0 if way * force > 0 else -1.0) + self.gamma + self.skew * way
        return self.slope - abs(force) ** self.order * pull


class JilesAtherton:
    """Domain walls pinned in a mean field; the input 0 ... 1 is a field from -1 to 1."""

    name = "jiles_atherton"

    def __init__(self, rng):
        self.shape = rng.uniform(0.18, 0.35)
        self.pinning = rng.uniform(0.1, 0.25)
        self.coupling = rng.uniform(0.2, 0.8) * self.shape
        self.bowing = rng.uniform(0.1, 0.35)
        self.reversible = _bent(rng)
        self.reversible_share = rng.uniform(0.0, 0.15)

    def _langevin(self, field):
        x = field / self.shape
        return x / 3.0 if abs(x) < 1e-3 else 1.0 / math.tanh(x) - 1.0 / x

    def hysteretic(self, x):
        wall, magnet, last, out = 0.0, 0.0, 0.0, np.empty(len(x))
        for k, value in enumerate((2.0 * np.asarray(x) - 1.0).tolist()):
            move = value - last
            pieces = 1 + int(abs(move) / 0.02)
            way = math.copysign(1.0, move)
            for piece in range(1, pieces + 1):
                field = last + move * piece / pieces
                ideal = self._langevin(field + self.coupling * magnet)
                lack = ideal - wall
                # Walls never move against the field (the usual guard against negative susceptibility).
                if lack * way > 0.0:
                    stiff = self.pinning * way - self.coupling * lack
                    wall += lack / stiff * (move / pieces) if stiff * way > 0.02 else lack
                magnet = self.bowing * ideal + (1.0 - self.bowing) * wall
            out[k], last = magnet, value
        return out


KINDS = (DensePlays, Preisach, BoucWen, JilesAtherton)
