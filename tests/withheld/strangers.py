"""Effects that are in nobody's catalogue: the right answer to each is `unknown`."""
import numpy as np

from effects import Effect
from filters import lag


class Stranger(Effect):
    stage = "material"

    def label(self):
        return "unknown"


class SelfHeating(Stranger):
    """Losses in the loop warm the material, which nobody measures; its gain falls and its zero moves with it."""

    name, span = "self_heating", (1e-3, 8.0)

    def draw(self, rng, plan):
        self.time = rng.uniform(0.03, 0.15) * plan.samples
        self.offset = rng.uniform(-0.6, 0.6)
        self.scale = None

    def apply(self, signal, ctx):
        heat = lag(np.diff(signal, prepend=signal[0]) ** 2, self.time)
        if self.scale is None:
            self.scale = float(heat.max())
        warm = heat / self.scale
        return signal * np.exp(-self.strength * warm) + self.strength * self.offset * warm * (1.0 - 0.7 * warm)


class ContactLoss(Stranger):
    """A tip that loses contact for moments, and falls towards rest while it does."""

    name, span = "contact_loss", (0.01, 3.0)

    def draw(self, rng, plan):
        self.level = rng.uniform(-0.2, 0.2)

    def apply(self, signal, ctx):
        dice = ctx.random(self.rng_seed)
        lost = np.zeros(len(signal))
        for start in np.flatnonzero(dice.uniform(size=len(signal)) < 0.0015):
            lost[start:start + dice.integers(8, 60)] = 1.0
        return signal - np.tanh(self.strength) * lag(lost, 3.0) * (signal - self.level)


class StickSlip(Stranger):
    """A guide that sticks until the strain breaks it loose, at a load that differs each time, and overshoots."""

    name, stage, span = "stick_slip", "sensor", (1e-3, 0.6)

    def apply(self, signal, ctx):
        loads = self.strength * ctx.random(self.rng_seed).uniform(0.3, 1.7, len(signal))
        out, held = np.empty(len(signal)), float(signal[0])
        for k, (value, load) in enumerate(zip(signal.tolist(), loads.tolist())):
            if abs(value - held) > load:
                held = value + 0.3 * (value - held)
            out[k] = held
        return out


class LevelDependentLag(Stranger):
    """A damper that is stiff at one end of its stroke and free at the other, and slower inwards than outwards."""

    name, stage, span = "level_dependent_lag", "sensor", (1.0, 1500.0)

    def draw(self, rng, plan):
        self.at = rng.uniform(0.3, 0.8)

    def apply(self, signal, ctx):
        out, x = np.empty(len(signal)), float(signal[0])
        for k, value in enumerate(signal.tolist()):
            near = np.exp(-((x - self.at) / 0.12) ** 2)
            time = 0.05 + self.strength * near * (1.0 if value > x else 0.15)
            x -= np.expm1(-1.0 / time) * (value - x)
            out[k] = x
        return out


class Barkhausen(Stranger):
    """Avalanches: jumps of random size where the material moves, which heal slowly."""

    name, span = "barkhausen", (1e-3, 20.0)

    def draw(self, rng, plan):
        self.heal = rng.uniform(20.0, 120.0)

    def apply(self, signal, ctx):
        dice = ctx.random(self.rng_seed)
        moved = np.abs(np.diff(signal, prepend=signal[0]))
        jumps = dice.standard_t(3, len(signal)) * np.sqrt(moved) * (dice.uniform(size=len(signal)) < 0.08)
        return signal + self.strength * self.heal * lag(jumps, self.heal) * 0.2


class Outliers(Stranger):
    """A bad cable: single samples and short bursts far off."""

    name, stage, span = "outliers", "sensor", (1e-3, 5.0)

    def draw(self, rng, plan):
        self.rate = rng.uniform(0.004, 0.02)

    def apply(self, signal, ctx):
        dice = ctx.random(self.rng_seed)
        hit = (dice.uniform(size=len(signal)) < self.rate) * dice.standard_t(3, len(signal))
        return signal + self.strength * hit


STRANGERS = {c.name: c for c in (SelfHeating, ContactLoss, StickSlip, LevelDependentLag, Barkhausen, Outliers)}
