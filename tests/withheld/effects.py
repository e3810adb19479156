"""The catalogue's effects as physics of their own, each with one `strength` that sets its size.

A stage takes and returns a signal; `ctx` is the record at hand (plant.Context). Times are in samples. Each class names
its catalogue entry, the stage it acts in, and the span in which its strength may be searched.
"""
import numpy as np

from filters import lag, log_spectrum, second_order


class Effect:
    transferable = True

    def __init__(self, rng, plan):
        self.rng_seed = int(rng.integers(1 << 31))
        self.strength = 0.0
        self.draw(rng, plan)

    def draw(self, rng, plan):
        """Draws what is fixed for the plant: everything but the strength."""

    def label(self):
        return self.name


# ---- drive: ahead of the hysteresis -------------------------------------------------------------------------------


class Delay(Effect):
    """A buffered link: the delay wanders by a few per cent. It may sit in the drive or in the measurement."""

    name, span = "delay", (0.05, 120.0)

    def draw(self, rng, plan):
        self.stage = "drive" if rng.uniform() < 0.6 else "sensor"

    def apply(self, signal, ctx):
        k = np.arange(len(signal))
        jitter = 1.0 + 0.03 * lag(ctx.noise(self.rng_seed), 20.0)
        return np.interp(k - self.strength * jitter, k, signal)


class InputLag(Effect):
    """Amplifier resistance into a capacitance that grows with the voltage on it (piezo), or a heat loss that does."""

    name, stage, span = "input_lag", "drive", (0.05, 400.0)

    def draw(self, rng, plan):
        self.growth = rng.uniform(-0.15, 0.35)

    def apply(self, signal, ctx):
        return lag(signal, self.strength, lambda v: 1.0 + self.growth * v)


class SlewLimit(Effect):
    """An amplifier's current limit into a load: source and sink differ, and a small source resistance stays."""

    name, stage, span = "slew_limit", "drive", (1.0, 3000.0)  # samples for the whole range

    def draw(self, rng, plan):
        self.sink = rng.uniform(0.8, 1.25)
        self.resistance = rng.uniform(0.3, 1.0)

    def apply(self, signal, ctx):
        rise, out = 1.0 / self.strength, np.empty(len(signal))
        fall = rise * self.sink
        follow = -np.expm1(-1.0 / self.resistance)
        v = float(signal[0])
        for k, want in enumerate(signal.tolist()):
            v += max(-fall, min(rise, follow * (want - v)))
            out[k] = v
        # The resistance belongs to the plant the bench saw as well: only the limit is the effect.
        return out - lag(signal, self.resistance) + signal


# ---- body ---------------------------------------------------------------------------------------------------------


class RateDependence(Effect):
    """Viscous plays where the body has plays; else eddy-current diffusion into layers, or an excess field that goes
    with the root of the rate, both on the hysteretic part alone."""

    name, stage, span = "rate_dependence", "body", (0.002, 400.0)
    LAYERS = 5

    def draw(self, rng, plan):
        self.mechanism = "viscous" if plan.body == "plays" else str(rng.choice(["diffusion", "excess"]))
        self.spread = rng.uniform(0.3, 1.0)

    def run(self, plant, v, ctx):
        body, before = plant.body, ctx.prehistory
        reversible = body.reversible(v)
        if self.mechanism == "viscous":
            times = self.strength * (1.0 + self.spread * body.radius / body.radius[-1])
            past = body.hysteretic(np.concatenate([before, v]), times)
            return plant.mix(past[len(before):], reversible)
        if self.mechanism == "excess":
            return plant.mix(plant.hysteretic(self._excess(v), ctx), reversible)
        layers = [plant.hysteretic(layer, ctx) for layer in self._diffuse(v)]
        return plant.mix(np.mean(layers, axis=0), reversible)

    def _excess(self, v):
        """Walls move at a rate that grows with the square of the excess field: q^2 + c q = gap, q^2 the move."""
        drag, out, x = 0.01 * self.strength, np.empty(len(v)), float(v[0])
        for k, want in enumerate(v.tolist()):
            gap = want - x
            root = 0.5 * (np.sqrt(drag * drag + 4.0 * abs(gap)) - drag)
            x += np.copysign(min(root * root, abs(gap)), gap)
            out[k] = x
        return out

    def _diffuse(self, v):
        """Implicit steps of the heat equation across half a lamination, the surface held at v."""
        count = self.LAYERS
        rate = count * count / (2.5 * self.strength)
        matrix = np.diag(np.full(count, 1.0 + 2.0 * rate)) - rate * (np.eye(count, k=1) + np.eye(count, k=-1))
        matrix[-1, -1] = 1.0 + rate
        inverse = np.linalg.inv(matrix)
        feed = inverse[:, 0] * rate
        layer, out = np.full(count, float(v[0])), np.empty((len(v), count))
        for k, surface in enumerate(v.tolist()):
            layer = inverse @ layer + feed * surface
            out[k] = layer
        return out.T


class Noncongruency(Effect):
    """A mean field that moves the input with the remanence, or a reversible part whose stiffness depends on it. Both
    leave the middle of the major loop alone: what changes is loops between equal reversals at other levels."""

    name, stage, span = "noncongruency", "body", (0.002, 3.0)

    def draw(self, rng, plan):
        self.mechanism = str(rng.choice(["mean_field", "reversible"]))
        self.sign = rng.choice([-1.0, 1.0])

    def run(self, plant, v, ctx):
        plain = plant.mix(plant.hysteretic(v, ctx), plant.body.reversible(v))
        if self.mechanism == "reversible":
            stiffness = 2.0 * self.sign * self.strength * plant.excess(plain, v)
            return plain + stiffness * (plant.body.reversible(v) - 0.5)
        out = plain
        for _ in range(5):  # a fixed point; the feedback's loop gain stays below 1 at the cap
            x = np.clip(v + self.sign * min(self.strength, 0.25) * plant.excess(out, v), -0.1, 1.1)
            out = plant.mix(plant.hysteretic(x, ctx), plant.body.reversible(v))
        return out


class InitialState(Effect):
    """Somebody worked with the plant before the record began: the memory holds loops the model does not know."""

    name, stage, span, transferable = "initial_state", "body", (0.01, 1.0), False

    def draw(self, rng, plan):
        self.peaks = rng.uniform(0.3, 1.0, 3)

    def run(self, plant, v, ctx):
        start = float(v[0])
        points = [1.0, 0.0]
        for peak, fade in zip(self.peaks, (1.0, 0.6, 0.3)):
            points += [start + self.strength * (1.0 - start) * fade * max(peak, 0.6), start]
        history = np.concatenate([np.linspace(a, b, 60) for a, b in zip(points, points[1:])])
        return plant.mix(plant.hysteretic(v, ctx, history), plant.body.reversible(v))


# ---- material: acts on the body's response --------------------------------------------------------------------------


class GainOffset(Effect):
    """Changed preload: the response's gain, its offset, or both."""

    name, stage, span = "gain_offset", "material", (1e-4, 0.6)

    def draw(self, rng, plan):
        angle = rng.uniform(0, 2 * np.pi)
        self.gain, self.offset = 1.5 * np.cos(angle), np.sin(angle)

    def apply(self, signal, ctx):
        return signal * (1.0 + self.strength * self.gain) + self.strength * self.offset


class Creep(Effect):
    """Relaxation with a dense spectrum over the decades of the record, or a fractional (power-law) compliance."""

    name, stage, span = "creep", "material", (1e-4, 1.0)

    def draw(self, rng, plan):
        self.fractional = rng.uniform() < 0.5
        self.order = rng.uniform(0.1, 0.35)
        self.onset = rng.uniform(8.0, 30.0)
        self.times = np.geomspace(self.onset, rng.uniform(0.3, 2.0) * plan.samples, 30)

    def apply(self, signal, ctx):
        moved = signal - signal[0]
        if not self.fractional:
            return signal + self.strength * log_spectrum(moved, self.times)
        n = len(signal)
        compliance = (1.0 + np.arange(n) / self.onset) ** self.order - 1.0
        compliance /= (1.0 + 6000.0 / self.onset) ** self.order - 1.0
        size = 2 * n
        grown = np.fft.irfft(np.fft.rfft(np.diff(signal, prepend=signal[0]), size) * np.fft.rfft(compliance, size), size)
        return signal + self.strength * grown[:n]


class Wear(Effect):
    """Damage that grows with a power of each move, as in fatigue; the response fades, or grows as surfaces run in."""

    name, stage, span = "wear", "material", (1e-4, 1.2)

    def draw(self, rng, plan):
        self.power = rng.uniform(1.0, 2.0)
        self.grows = rng.uniform() < 0.3
        self.life = None
        self.pivot = rng.uniform(-0.1, 0.3)

    def apply(self, signal, ctx):
        damage = np.cumsum(np.abs(np.diff(signal, prepend=signal[0])) ** self.power)
        if self.life is None:
            self.life = float(damage[-1])  # scale of the working record; kept for the test record
        worn = damage / self.life
        factor = 1.0 + self.strength * (1.0 - np.exp(-2.0 * worn)) if self.grows else np.exp(-self.strength * worn)
        return self.pivot + (signal - self.pivot) * factor


class Exogenous(Effect):
    """A material law of a measured column: it sets the gain, the offset or the width of the loop."""

    name, span = "exogenous", (1e-4, 0.9)
    LAWS = (lambda q: 1.0 / (1.0 + 0.4 * q) - 1.0,  # Curie-Weiss
            lambda q: np.expm1(0.6 * q),  # Arrhenius
            lambda q: 0.8 * q + 0.3 * q * q)  # expansion with its second order

    def draw(self, rng, plan):
        self.column = plan.exogenous_column
        self.mechanism = str(rng.choice(["gain", "offset", "width"]))
        self.stage = "body" if self.mechanism == "width" else "material"
        self.law = self.LAWS[rng.integers(3)]
        self.pivot = rng.uniform(-0.2, 0.3)

    def label(self):
        return "exogenous:" + self.column

    def state(self, ctx):
        return self.strength * self.law(ctx.aux[self.column])

    def run(self, plant, v, ctx):
        squeezed = 0.5 + (v - 0.5) * (1.0 - np.clip(self.state(ctx), -0.15, 0.6))
        return plant.mix(plant.hysteretic(squeezed, ctx), plant.body.reversible(v))

    def apply(self, signal, ctx):
        if self.mechanism == "offset":
            return signal + self.state(ctx)
        return self.pivot + (signal - self.pivot) * (1.0 + self.state(ctx))


# ---- sensor side ------------------------------------------------------------------------------------------------------


class Resonance(Effect):
    """A cantilever between material and sensor: its first two bending modes (frequencies 1 : 6.267)."""

    name, stage, span = "resonance", "sensor", (2.2, 250.0)  # first mode's period in samples

    def draw(self, rng, plan):
        self.damping = np.exp(rng.uniform(np.log(0.01), np.log(0.08)))
        self.share = rng.uniform(0.86, 0.95)

    def apply(self, signal, ctx):
        first = second_order(signal, self.strength, self.damping)
        second = second_order(signal, self.strength / 6.267, 1.5 * self.damping)
        return self.share * first + (1.0 - self.share) * second


class Backlash(Effect):
    """Gear play with a compliant contact and a trace of drag on the driven side."""

    name, stage, span = "backlash", "sensor", (1e-4, 0.3)

    def draw(self, rng, plan):
        self.contact = rng.uniform(0.3, 1.5)

    def apply(self, signal, ctx):
        follow, out = -np.expm1(-1.0 / self.contact), np.empty(len(signal))
        driven = float(signal[0]) + self.strength  # as a descent has left it
        for k, drive in enumerate(signal.tolist()):
            gap = drive - driven
            if abs(gap) > self.strength:
                driven += follow * (gap - np.copysign(self.strength, gap))
            out[k] = driven
        # The contact's own compliance is no lost motion.
        return out + signal - lag(signal, self.contact)


class OutputSaturation(Effect):
    """An amplifier that runs into one or both rails, with a knee."""

    name, stage, span = "output_saturation", "sensor", (0.005, 0.9)

    def draw(self, rng, plan):
        self.rails = [(0, 1), (1, 0), (1, 1)][rng.integers(3)]
        self.knee = rng.uniform(0.003, 0.02)

    def apply(self, signal, ctx):
        out, far = signal, 8.0 * self.knee  # where the knee's own exp(-8) no longer shows
        if self.rails[1]:
            out = out - self.knee * np.logaddexp(0.0, (out - (1.0 + far - self.strength)) / self.knee)
        if self.rails[0]:
            out = out + self.knee * np.logaddexp(0.0, (self.strength - far - out) / self.knee)
        return out


class OutputNonlinearity(Effect):
    """A capacitive gap, a thermistor bridge or an optical lever, trimmed to be right at both ends of the range."""

    name, stage, span = "output_nonlinearity", "sensor", (1e-3, 3.0)

    def draw(self, rng, plan):
        self.kind = int(rng.integers(3))

    def apply(self, signal, ctx):
        s, y = self.strength, np.clip(signal, -0.25, 1.25)
        if self.kind == 0:
            return y / (1.0 + 0.7 * s * (1.0 - y) / (1.0 + s))
        if self.kind == 1:
            bent = np.log1p(s * (y + 0.3))
            foot, head = np.log1p(0.3 * s), np.log1p(1.3 * s)
            return (bent - foot) / (head - foot)
        reach = min(s, 1.3)
        return 0.5 + 0.5 * np.sin(reach * (2.0 * y - 1.0)) / np.sin(reach)


class OutputLag(Effect):
    """A sensor in a sheath: one slow pole, and a second seven times faster."""

    name, stage, span = "output_lag", "sensor", (0.05, 400.0)

    def apply(self, signal, ctx):
        return lag(lag(signal, self.strength), 0.14 * self.strength)


# ---- added to the measurement -------------------------------------------------------------------------------------------


class Drift(Effect):
    """Warm-up of the electronics plus a smoothed random walk."""

    name, stage, span, transferable = "drift", "sensor", (1e-5, 0.8), False

    def draw(self, rng, plan):
        self.warm = rng.uniform(0.15, 0.6) * plan.samples
        self.mix = rng.uniform(0.2, 0.8)

    def apply(self, signal, ctx):
        n = len(signal)
        walk = np.cumsum(ctx.noise(self.rng_seed)) / np.sqrt(n)
        walk = lag(lag(walk - walk[0], 0.03 * n), 0.03 * n)
        warm = -np.expm1(-np.arange(n) / self.warm)
        return signal + self.strength * (self.mix * warm + (1.0 - self.mix) * 2.0 * walk)


class PeriodicDisturbance(Effect):
    """A machine next door: a fundamental with two harmonics, whose speed and force wander a little."""

    name, stage, span = "periodic_disturbance", "sensor", (1e-5, 0.5)

    def draw(self, rng, plan):
        self.period = np.exp(rng.uniform(np.log(7.0), np.log(160.0)))
        self.harmonics = rng.uniform(0.0, [0.35, 0.2])
        self.phases = rng.uniform(0, 2 * np.pi, 3)

    def apply(self, signal, ctx):
        n = len(signal)
        wander = lag(ctx.noise(self.rng_seed), 0.1 * n) * np.sqrt(0.1 * n)
        phase = 2 * np.pi * np.arange(n) / self.period + 0.15 * wander
        wave = np.sin(phase + self.phases[0])
        for order, (share, shift) in enumerate(zip(self.harmonics, self.phases[1:]), 2):
            wave = wave + share * np.sin(order * phase + shift)
        return signal + self.strength * wave * (1.0 + 0.05 * wander)


class Quantization(Effect):
    """A converter with few codes whose widths differ by some per cent; acts on the noisy signal."""

    name, stage, span = "quantization", "converter", (1e-4, 0.5)

    def draw(self, rng, plan):
        self.uneven = rng.uniform(0.0, 0.1)
        self.origin = rng.uniform()

    def apply(self, signal, ctx):
        codes = np.round(signal / self.strength + self.origin)
        # A fixed pseudo-random error for each code, from the fractional part of its multiple of the golden ratio.
        error = self.uneven * ((codes * 0.6180339887) % 1.0 - 0.5)
        return (codes - self.origin + error) * self.strength


CATALOGUE = {c.name: c for c in (
    GainOffset, Delay, InputLag, SlewLimit, RateDependence, Creep, Noncongruency, Wear, InitialState, OutputLag,
    Resonance, Backlash, OutputSaturation, OutputNonlinearity, Drift, PeriodicDisturbance, Quantization, Exogenous)}
