"""One case: a plant with the effects of its card, three records, and the truth about them."""
import numpy as np

import bodies
import commands
import plant as plants
from draw import DOUBTS, SEEDS
from effects import CATALOGUE
from strangers import STRANGERS

# A rival explanation stands when its best fit leaves less than this share of the noise RMS: the error after it would
# exceed the noise by sqrt(1 + 0.5^2) - 1 = 12 %, less than what the bodies' own misfit does.
DOUBT_RESIDUAL = 0.5
RIVAL_DRAWS = 3  # a rival's own time constants and mechanism may vary too
GOLDEN = 0.6180339887


class Case:
    def __init__(self, seed_name, card):
        self.card, self.samples = card, card["samples"]
        rng = np.random.default_rng([SEEDS[seed_name], 1, card["index"]])
        kind = {k.name: k for k in bodies.KINDS}[card["body"]]
        self.plant = plants.Plant(rng, kind)
        self.setting = self._setting(rng)
        self.step = float(rng.choice([2e-4, 1e-3, 5e-3, 2e-2, 0.1, 1.0]))
        self.noise = float(np.exp(rng.uniform(np.log(5e-4), np.log(3e-3))))
        self.colour = float(rng.uniform(0.4, 0.8)) if card["coloured"] else 0.0
        self.drops = 0.03 if rng.uniform() < 0.12 else 0.0
        self.fine_code = float(rng.choice([0.0, 2.0 ** -16, 2.0 ** -14]))
        self.units = plants.INPUTS[rng.integers(len(plants.INPUTS))], float(rng.choice(plants.SCALES)), rng.uniform(-1, 1)
        self.columns = plants.courses(rng, self.samples, 1.0)
        self.plan = plants.Plan(card["body"], self.samples, str(rng.choice(list(self.columns))))
        self.effects = [{**CATALOGUE, **STRANGERS}[name](rng, self.plan) for name in card["effects"]]
        self.seed = int(rng.integers(1 << 31))

    def _setting(self, rng):
        kinds = rng.permutation(list(commands.MIXED))[:int(rng.integers(4, 8))]
        base = np.exp(rng.uniform(np.log(180), np.log(500)))
        return {"work": self.card["work"], "kinds": [str(k) for k in kinds],
                "pace": base if self.samples > 3000 else 0.5 * base,
                "calm_start": "initial_state" in self.card["effects"]}

    def record(self, salt, fixed_columns=None):
        """(command, context) of a working record."""
        rng = np.random.default_rng([self.seed, salt])
        u = plants.working_command(rng, self.samples, self.setting)
        aux = plants.courses(rng, self.samples, 1.0) if fixed_columns is None else fixed_columns
        if fixed_columns is None:
            aux = dict(zip(self.columns, aux.values()))
        return u, plants.Context(self.seed + salt, self.samples, plants.prehistory(u[0]), aux)

    def effect_signal(self, record, plain, effects):
        u, ctx = record
        signal = self.plant.respond(u, ctx, effects)
        for effect in effects:
            if effect.stage == "converter":
                return signal - plain + self._rounding(effect, signal, ctx)
        return signal - plain

    def _rounding(self, effect, signal, ctx):
        noisy = signal + self.noise * ctx.noise(99)
        return effect.apply(noisy, ctx) - noisy

    def size_effects(self, record, plain):
        """Sets each effect's strength so that alone it adds its card's size, in noise RMS, to the record."""
        for effect, size in zip(self.effects, self.card["sizes"]):
            self._search(effect, np.log(size * self.noise), record, plain)

    def _rms(self, effect, record, plain, log_strength):
        effect.strength = float(np.exp(log_strength))
        return float(np.log(np.sqrt(np.mean(self.effect_signal(record, plain, [effect]) ** 2)) + 1e-30))

    def _search(self, effect, target, record, plain):
        """Bracketed secant on the log of the size over the log of the strength; stops within 8 %."""
        low, high = np.log(effect.span[0]), np.log(effect.span[1])
        value_low = value_high = None
        guess = 0.5 * (low + high)
        for _ in range(12):
            value = self._rms(effect, record, plain, guess)
            if abs(value - target) < 0.08:
                return
            if value < target:
                low, value_low = guess, value
            else:
                high, value_high = guess, value
            if value_low is not None and value_high is not None and value_high > value_low:
                share = np.clip((target - value_low) / (value_high - value_low), 0.15, 0.85)
                guess = low + share * (high - low)
            else:  # one side only: nearly every effect grows with its strength
                guess = np.clip(guess + (target - value), low + 0.1 * (high - low), high - 0.1 * (high - low))
                if high - low < 0.02:
                    return

    def measured(self, record, noise_free, salt):
        """What the sensor and the converter make of the noise-free output."""
        _u, ctx = record
        converters = [e for e in self.effects if e.stage == "converter"]
        if converters:
            white = noise_free + self.noise * ctx.noise(99)
            return converters[0].apply(white, ctx)
        rng = np.random.default_rng([self.seed, salt, 5])
        out = noise_free + self.noise * plants.coloured_noise(rng, len(noise_free), self.colour)
        return np.round(out / self.fine_code) * self.fine_code if self.fine_code else out

    def doubtful(self, record, plain, effect_record):
        """Effects of the same doubt that, at their best, leave less than the noise hides."""
        rivals = [n for n in DOUBTS.get(self.card["work"], ()) if n not in self.card["effects"]]
        limit, rng = DOUBT_RESIDUAL * self.noise, np.random.default_rng([self.seed, 7])
        size = np.log(np.sqrt(np.mean(effect_record ** 2)) + 1e-30)

        def stands(name):
            if name == "drift":
                return self._slow_misfit(effect_record) <= limit
            for _ in range(RIVAL_DRAWS):
                rival = CATALOGUE[name](rng, self.plan)
                self._search(rival, size, record, plain)
                if self._best_misfit(rival, record, plain, effect_record) <= limit:
                    return True
            return False

        return [name for name in rivals if stands(name)]

    @staticmethod
    def _slow_misfit(wanted):
        """What a course of ten straight pieces over the record leaves."""
        hats = np.eye(11)
        k = np.linspace(0, 1, len(wanted))
        basis = np.stack([np.interp(k, np.linspace(0, 1, 11), hat) for hat in hats], 1)
        course = basis @ np.linalg.lstsq(basis, wanted, rcond=None)[0]
        return float(np.sqrt(np.mean((course - wanted) ** 2)))

    def _best_misfit(self, rival, record, plain, wanted):
        """Golden section over the log of the strength, a factor two either way."""
        def misfit(log_strength):
            rival.strength = float(np.exp(log_strength))
            return float(np.sqrt(np.mean((self.effect_signal(record, plain, [rival]) - wanted) ** 2)))

        low, high = np.log(rival.strength) - 0.7, np.log(rival.strength) + 0.7
        left, right = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
        at_left, at_right = misfit(left), misfit(right)
        for _ in range(12):
            if at_left < at_right:
                high, right, at_right = right, left, at_left
                left = high - GOLDEN * (high - low)
                at_left = misfit(left)
            else:
                low, left, at_left = left, right, at_right
                right = low + GOLDEN * (high - low)
                at_right = misfit(right)
        return min(at_left, at_right)

    def build(self):
        """{name: (time, input, output, columns, effect)} for the three records, in physical units, and the truth."""
        record = self.record(1, self.columns)
        plain = self.plant.respond(*record, [])
        self.size_effects(record, plain)
        parts, rmse = {}, {}
        for name, salt in (("record", 1), ("test", 2)):
            run = record if salt == 1 else self.record(salt)
            base = plain if salt == 1 else self.plant.respond(*run, [])
            effect = self.effect_signal(run, base, self.effects)
            smooth = self.plant.respond(*run, self.effects)
            rmse[name] = {"effect_rmse": float(np.sqrt(np.mean(effect ** 2))) * self.units[1]}
            parts[name] = self._physical(run, self.measured(run, smooth, salt), effect, self.step, salt)
            if salt == 1:
                doubts = self.doubtful(run, base, effect) if self.card["kind"] == "one_kind" else []
        parts["calibration"], span = self._calibration()
        return parts, self._truth(rmse, doubts, span)

    def _calibration(self):
        rng = np.random.default_rng([self.seed, 3])
        u = commands.calibration(rng, 4000)
        samples = len(u)
        aux = dict(zip(self.columns, plants.courses(rng, samples, 0.02).values()))
        ctx = plants.Context(self.seed + 3, samples, plants.prehistory(u[0]), aux)
        smooth = self.plant.respond(u, ctx, [])
        noisy = smooth + self.noise * plants.coloured_noise(rng, samples, self.colour)
        slow = self.step * float(rng.choice([10, 20, 40]))
        return self._physical((u, ctx), noisy, np.zeros(samples), slow, 3), float(np.ptp(smooth))

    def _physical(self, record, measured, effect, step, salt):
        u, ctx = record
        (low, high), scale, shift = self.units
        rng = np.random.default_rng([self.seed, salt, 11])
        keep = rng.uniform(size=len(u)) >= self.drops
        keep[0] = True
        columns = {name: rest + swing * (ctx.aux[name] + 0.003 * rng.standard_normal(len(u)))
                   for name, (rest, swing) in plants.COLUMNS.items() if name in ctx.aux}
        return {"time": (np.arange(len(u)) * step)[keep], "input": (low + (high - low) * u)[keep],
                "output": (scale * (measured + shift))[keep],
                **{name: column[keep] for name, column in columns.items()}}, (scale * effect)[keep]

    def _truth(self, rmse, doubts, span):
        names = sorted(effect.label() for effect in self.effects)
        return {"effects": names, "noise": self.noise * self.units[1], "range": span * self.units[1], **rmse,
                "kind": self.card["kind"], "work": self.card["work"], "body": self.card["body"],
                "samples": self.samples, "coloured": bool(self.card["coloured"]), "sizes": self.card["sizes"],
                "sizes_reached": self._reached(), "physics": [type(e).__name__ for e in self.effects],
                "mechanisms": [str(getattr(e, "mechanism", "")) for e in self.effects],
                "strengths": [e.strength for e in self.effects], "doubts": doubts,
                "transferable": all(e.transferable for e in self.effects), "step": self.step,
                "pace": float(self.setting["pace"]), "commands": self.setting["kinds"]}

    def _reached(self):
        record = self.record(1, self.columns)
        plain = self.plant.respond(*record, [])
        return [float(np.exp(self._rms(e, record, plain, np.log(e.strength)))) / self.noise for e in self.effects]
