#!/usr/bin/env python3
"""Checks the check: the bodies' physics, the effects' sizes, the seal, the scoring. Exit code 77 without numpy."""
import os
import sys
import tempfile
import unittest

try:
    import numpy as np
except ImportError:
    print("skipped: no numpy (sh tests/withheld/install.sh)")
    sys.exit(77)

import bodies
import score
from case import Case
from draw import PATTERN, SEEDS, deck
from effects import CATALOGUE
from generate import folders, write_case
from measured import RECORDS
from plant import Context, Plant, prehistory
from strangers import STRANGERS
from where import true_share

EXACT = 1e-9  # of a range of 1: some thousand additions of rounding 1e-16, with a wide margin


def card_with(kind, name, size, body="plays"):
    return {"index": 7, "kind": kind, "work": "mixed", "samples": 1800, "body": body, "coloured": False,
            "effects": [name], "sizes": [size]}


class Bodies(unittest.TestCase):
    def setUp(self):
        rng = np.random.default_rng(4)
        self.ends = rng.uniform(0, 1, 20)
        self.coarse = np.concatenate([np.linspace(a, b, 60) for a, b in zip(self.ends, self.ends[1:])])

    def test_rate_independent(self):
        """Samples put between two others change nothing: exactly for plays and relays, and for the two differential
        equations less and less as their steps shrink."""
        fine = np.interp(np.arange(2 * len(self.coarse) - 1) / 2.0, np.arange(len(self.coarse)), self.coarse)
        for kind in bodies.KINDS:
            body = kind(np.random.default_rng(1))
            moved = np.abs(body.hysteretic(fine)[::2] - body.hysteretic(self.coarse)).max()
            span = np.ptp(body.hysteretic(self.coarse))
            # First-order steps of 1/100 of the input's range leave at most about that much of the output's.
            bound = EXACT if kind in (bodies.DensePlays, bodies.Preisach) else 0.02 * span
            self.assertLessEqual(moved, bound, kind.name)

    def test_wiping_out(self):
        """Plays and relays forget an inner loop once the input passes where it began."""
        inner = np.interp(np.arange(301), [0, 100, 150, 200, 300], [0.0, 0.6, 0.3, 0.6, 0.9])
        straight = np.interp(np.arange(201), [0, 100, 200], [0.0, 0.6, 0.9])
        for kind in (bodies.DensePlays, bodies.Preisach):
            body = kind(np.random.default_rng(2))
            self.assertLessEqual(abs(body.hysteretic(inner)[-1] - body.hysteretic(straight)[-1]), EXACT)

    def test_anticlockwise(self):
        """The falling branch lies above the rising one, everywhere on the major loop."""
        for kind in bodies.KINDS:
            plant = Plant(np.random.default_rng(3), kind)
            cycle = np.concatenate([np.linspace(0, 1, 200), np.linspace(1, 0, 200)])
            # Three cycles first: a Bouc-Wen element only approaches its loop.
            out = plant.body.hysteretic(np.tile(cycle, 4))[-400:]
            rising, falling = out[:200], out[200:][::-1]
            self.assertGreaterEqual((falling - rising).min(), -EXACT, kind.name)
            self.assertGreater((falling - rising).max(), 0.02 * np.ptp(out), kind.name)


class Effects(unittest.TestCase):
    def test_size_is_the_cards(self):
        """The effect adds its card's size: the search stops within 8 % in the logarithm (case._search)."""
        for name in {**CATALOGUE, **STRANGERS}:
            case = Case("tuning", card_with("single", name, 5.0))
            record = case.record(1, case.columns)
            plain = case.plant.respond(*record, [])
            case.size_effects(record, plain)
            size = np.sqrt(np.mean(case.effect_signal(record, plain, case.effects) ** 2)) / case.noise
            self.assertLessEqual(abs(np.log(size / 5.0)), 0.08, name)

    def test_vanishes_with_its_strength(self):
        """At the least strength in its span an effect is lost in the noise of 6000 samples (1 / sqrt(6000) of it),
        but for those whose least is set by the sampling."""
        for name in set(CATALOGUE) - {"resonance", "slew_limit", "rate_dependence", "delay", "input_lag", "output_lag"}:
            case = Case("tuning", card_with("single", name, 1.0))
            record = case.record(1, case.columns)
            plain = case.plant.respond(*record, [])
            for effect in case.effects:
                effect.strength = 1e-6
            moved = case.effect_signal(record, plain, case.effects)
            self.assertLessEqual(np.sqrt(np.mean(moved ** 2)), case.noise / np.sqrt(6000), name)

    def test_calibration_is_without_effect(self):
        """The calibration is the plant's answer with every stage empty, noise apart."""
        case = Case("tuning", card_with("single", "creep", 50.0))
        parts, _truth = case.build()
        columns, effect = parts["calibration"]
        self.assertEqual(float(np.abs(effect).max()), 0.0)
        (low, high), scale, shift = case.units
        u = (columns["input"] - low) / (high - low)
        plain = case.plant.respond(u, Context(0, len(u), prehistory(u[0])), [])
        residual = columns["output"] / scale - shift - plain
        # Standard deviation of white noise from n samples is known to 1 / sqrt(2 n); five of those.
        self.assertLessEqual(abs(residual.std() / case.noise - 1.0), 5.0 / np.sqrt(2.0 * len(u)))


class Draw(unittest.TestCase):
    def test_deck_holds_everything(self):
        cards = deck("checking", 300)
        self.assertEqual({c["effects"][0] for c in cards if c["kind"] == "single"}, set(CATALOGUE))
        self.assertEqual({c["effects"][0] for c in cards if c["kind"] == "stranger"}, set(STRANGERS))
        for body in bodies.KINDS:
            for kind in set(PATTERN):
                self.assertTrue(any(c["body"] == body.name and c["kind"] == kind for c in cards), (body, kind))
        self.assertEqual(len(set(SEEDS.values())), len(SEEDS))

    def test_sealed(self):
        """Beside the records of a sealed seed lies nothing but records; the same card gives the same bytes."""
        with tempfile.TemporaryDirectory() as out:
            job = ("ci", deck("ci", 8)[7], os.path.join(out, "a"))
            name = write_case(job)
            write_case(job[:2] + (os.path.join(out, "b"),))
            folder, sealed = folders("ci", os.path.join(out, "a"), name)
            self.assertEqual(sorted(os.listdir(folder)), ["calibration.csv", "record.csv", "test.csv"])
            self.assertNotEqual(os.path.commonpath([folder, sealed]), folder)
            for part in os.listdir(folder):
                with open(os.path.join(folder, part), "rb") as one:
                    with open(os.path.join(folders("ci", os.path.join(out, "b"), name)[0], part), "rb") as two:
                        self.assertEqual(one.read(), two.read())


def row_for(card, verdict, confident):
    truth = [n if n in CATALOGUE else "unknown" for n in card["effects"]]
    right = verdict == truth
    return {"kind": card["kind"], "body": card["body"], "samples": card["samples"], "coloured": card["coloured"],
            "size": min(card["sizes"], default=0.0), "truth": truth, "verdict": verdict, "right": right, "in_set": right,
            "confident": confident, "confident_wrong": confident and not right, "set_size": 1, "error": None,
            "probability": 0.97, "predicted": [0.8, 0.7, 0.9], "predicted_planned": 0.8, "realised": 0.8, "transferable": True, "closed": 0.99,
            "test_before": 1.0, "test_after": 0.2, "where_error": 0.01, "diagnose_s": 1.0, "identified": 0.01}


class Scoring(unittest.TestCase):
    known = [{"in_set": True} for _ in RECORDS]

    def board(self, answer):
        rows = [row_for(card, answer(card), True) for card in deck("checking", 300)]
        return {line["key"]: line["holds"] for line in score.scoreboard(rows, self.known)["limits"]}

    def test_the_truth_passes(self):
        held = self.board(lambda card: [n if n in CATALOGUE else "unknown" for n in card["effects"]])
        self.assertEqual([key for key, ok in held.items() if ok is not True], [])

    def test_one_answer_for_all_fails(self):
        for answer in ([], ["creep"], ["unknown"]):
            held = self.board(lambda card, said=answer: said)
            for key in ("plays_large", "plays_pairs", "hard", "plays_confident_wrong", "calibration_error", "detected"):
                self.assertIs(held[key], False, (answer, key))

    def test_threshold_of_a_step(self):
        """Right from 2 x noise on, at sizes 1, 1.5, 2.25, ...: the threshold lies between the two around 2."""
        card = card_with("single", "creep", 1.0)
        rows = [row_for(dict(card, sizes=[s]), ["creep"] if s >= 2.0 else [], True) for s in 1.5 ** np.arange(8)]
        self.assertAlmostEqual(score.detection(rows)["creep"]["threshold"], np.sqrt(1.5 * 2.25))

    def test_small_draw_slack(self):
        """9 of 10 against 0.97: P(at most 9) = 1 - 0.97^10 = 0.26 holds in a small draw, 7 of 10 (0.003) does not."""
        figure = {"value": 0.9, "count": 9, "of": 10}
        self.assertTrue(score.holds(figure, "min", 0.97, True))
        self.assertFalse(score.holds(figure, "min", 0.97, False))
        self.assertFalse(score.holds({"value": 0.7, "count": 7, "of": 10}, "min", 0.97, True))

    def test_small_draw_slack_of_a_median(self):
        """4 of 10 errors within the limit, when half are expected: P(at most 4) = 0.38 holds; 1 of 10 (0.011) does not."""
        errors = [0.01] * 4 + [0.09] * 6
        self.assertTrue(score.holds({"value": 0.09, "of": 10, "values": errors}, "max", 0.05, True))
        self.assertFalse(score.holds({"value": 0.09, "of": 10, "values": errors}, "max", 0.05, False))
        errors = [0.01] + [0.09] * 9
        self.assertFalse(score.holds({"value": 0.09, "of": 10, "values": errors}, "max", 0.05, True))

    def test_where(self):
        record = {"time": np.arange(100.0), "input": np.r_[np.arange(50.0), np.arange(49.0, -1.0, -1.0)]}
        effect = np.where(np.arange(100) < 25, 2.0, 0.0)
        region = {"axis": "time", "from": 0.0, "to": 11.0}
        self.assertAlmostEqual(true_share(region, record, effect), 12.0 / 25.0)
        # The first sample has no direction yet and counts as holding.
        self.assertAlmostEqual(true_share({"axis": "direction", "value": "ascending"}, record, effect), 24.0 / 25.0)
        tone = np.sin(2 * np.pi * 0.1 * np.arange(100))
        self.assertAlmostEqual(true_share({"axis": "frequency", "from": 0.05, "to": 0.15}, record, tone), 1.0)

    def test_where_in_an_uneven_record(self):
        """Missing samples are filled in from their neighbours, whose mean is 0.95 of a tone of 0.05 cycles a sample, so
        the tone keeps 0.995 of its amplitude, and 0.95 x 0.05^2 x 0.1 of its energy is spread."""
        kept = np.arange(1000) % 10 != 5
        time = 0.01 * np.arange(1000)[kept]
        tone = np.sin(2 * np.pi * 5.0 * time)
        share = true_share({"axis": "frequency", "from": 4.9, "to": 5.1}, {"time": time, "input": time}, tone)
        self.assertAlmostEqual(share, 1.0, delta=1e-3)
        even = true_share({"axis": "frequency", "from": 0.0, "to": 50.0}, {"time": time, "input": time}, tone)
        self.assertAlmostEqual(even, 1.0)


if __name__ == "__main__":
    unittest.main()
