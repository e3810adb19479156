"""A plant: one body, its effects in their stages, its units and its sensor; and the records it gives."""
from dataclasses import dataclass, field

import numpy as np

import commands
from filters import lag

STAGES = ("drive", "body", "material", "sensor", "converter")
COLUMNS = {"temperature": (25.0, 9.0), "humidity": (48.0, 12.0), "load": (120.0, 60.0), "pressure": (3.0, 1.2),
           "supply": (24.0, 1.0)}  # rest value and swing
INPUTS = ((0.0, 100.0), (30.0, 90.0), (-1.0, 1.0), (0.0, 10.0), (-500.0, 500.0), (-20.0, 120.0))
SCALES = (40.0, 2.0, 0.8, 350.0, 1.0e-3, 12.0)


@dataclass
class Context:
    """What belongs to one record: its prehistory, its auxiliary columns (deviation from rest, about -1 ... 1), its dice."""
    seed: int
    samples: int
    prehistory: np.ndarray
    aux: dict = field(default_factory=dict)

    def random(self, salt):
        return np.random.default_rng([self.seed, salt])

    def noise(self, salt):
        return self.random(salt).standard_normal(self.samples)


@dataclass
class Plan:
    """What an effect may know when it draws its fixed parameters."""
    body: str
    samples: int
    exogenous_column: str


class Plant:
    def __init__(self, rng, kind):
        self.body = kind(rng)
        loop = np.concatenate([np.linspace(1, 0, 200), np.linspace(0, 1, 400), np.linspace(1, 0, 400)])
        part = self.body.hysteretic(loop)[200:]
        self.hysteretic_low, self.hysteretic_span = part.min(), part.max() - part.min()
        middle = 0.5 * (part[:400] + part[400:][::-1])
        self.middle = self.mix(middle, self.body.reversible(loop[200:600]))

    def hysteretic(self, x, ctx, history=None):
        before = ctx.prehistory if history is None else history
        return self.body.hysteretic(np.concatenate([before, x]))[len(before):]

    def mix(self, hysteretic, reversible):
        """Both parts, in [0, 1] over the major loop."""
        share = self.body.reversible_share
        return (1.0 - share) * (hysteretic - self.hysteretic_low) / self.hysteretic_span + share * reversible

    def excess(self, out, u):
        """How far the output lies above the middle of the major loop at this input."""
        return out - np.interp(u, np.linspace(0, 1, 400), self.middle)

    def respond(self, u, ctx, effects, stages=STAGES[:-1]):
        """The noise-free output, in [0, 1] over the calibration's range, for the command u."""
        by_stage = {stage: [e for e in effects if e.stage == stage] for stage in stages}
        signal = u
        for effect in by_stage["drive"]:
            signal = effect.apply(signal, ctx)
        if by_stage["body"]:
            signal = by_stage["body"][0].run(self, signal, ctx)
        else:
            signal = self.mix(self.hysteretic(signal, ctx), self.body.reversible(signal))
        for stage in ("material", "sensor"):
            for effect in by_stage[stage]:
                signal = effect.apply(signal, ctx)
        return signal


def prehistory(start):
    """From positive saturation down to the least input and to the record's first: the contract's start."""
    return np.concatenate([np.linspace(1.0, 0.0, 120), np.linspace(0.0, start, 40)])


def courses(rng, samples, swing):
    """Smooth courses of the auxiliary columns, all equally slow: one may matter, the others are decoys."""
    names = [str(name) for name in rng.choice(list(COLUMNS), 2, replace=False)]
    aux = {}
    k = np.arange(samples) / samples
    for name in names:
        waves = [rng.normal() / order * np.sin(2 * np.pi * (order * rng.uniform(0.6, 1.4) * k + rng.uniform()))
                 for order in range(1, 6)]
        course = np.sum(waves, axis=0) + 0.5 * rng.normal()
        aux[name] = swing * np.clip(course / max(1.2, np.abs(course).max()), -1, 1)
    return aux


def coloured_noise(rng, samples, colour):
    """Unit variance; `colour` is the share of the standard deviation that is slow."""
    white = rng.standard_normal(samples)
    if colour == 0.0:
        return white
    slow = lag(rng.standard_normal(samples), 12.0)
    slow /= slow.std()
    return np.sqrt(1.0 - colour * colour) * white + colour * slow


def working_command(rng, samples, setting):
    if setting["work"] in commands.SINGLE:
        return np.clip(commands.SINGLE[setting["work"]](rng, samples, setting["pace"]), 0, 1)
    return commands.mixed(rng, samples, setting["pace"], setting["kinds"], setting["calm_start"])
