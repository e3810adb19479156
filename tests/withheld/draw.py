"""Which cases there are: named seeds and a deck that is representative from its first card on."""
import numpy as np

import bodies
from effects import CATALOGUE
from strangers import STRANGERS

# Truths are drawn from these alone. Tuning is for looking at; checking gives the published scoreboard and is never
# looked into case by case; ci is the small draw that every change must hold.
SEEDS = {"tuning": 20251, "checking": 77003, "ci": 41117}

# Every 20 cards: 10 single effects, 3 pairs, 2 none, 3 strangers, 2 of one kind of work.
PATTERN = ("single", "none", "single", "pair", "single", "stranger", "single", "one_kind", "single", "single", "pair",
           "single", "stranger", "single", "none", "single", "one_kind", "single", "pair", "stranger")

# Records of one kind of work: the causes among which each leaves a doubt.
DOUBTS = {"sine": ("delay", "input_lag", "output_lag", "rate_dependence"),
          "triangle": ("delay", "input_lag", "output_lag", "backlash"),
          "equal_steps": ("creep", "output_lag", "input_lag", "rate_dependence"),
          "staircase_hold": ("creep", "drift", "output_lag")}

# Two effects in one stage of the body would need one joint physics; leave those pairs out.
BODY = ("rate_dependence", "noncongruency", "initial_state", "exogenous")


def _pairs():
    names = list(CATALOGUE)
    return [(a, b) for i, a in enumerate(names) for b in names[i + 1:] if not (a in BODY and b in BODY)]


def _size(index, low, high):
    """Log-even in any run of cards: the golden ratio's multiples."""
    return float(low * (high / low) ** ((index * 0.6180339887) % 1.0))


def deck(seed_name, count):
    """`count` cards, each a dict with the kind of case, its effects and sizes (in noise RMS), body and record form."""
    rng = np.random.default_rng(SEEDS[seed_name])
    singles = list(rng.permutation(list(CATALOGUE)))
    pairs = rng.permutation(np.array(_pairs()))
    strangers = list(rng.permutation(list(STRANGERS)))
    doubts = [(work, name) for work in DOUBTS for name in DOUBTS[work]]
    doubts = [doubts[i] for i in rng.permutation(len(doubts))]
    seen = dict.fromkeys(PATTERN, 0)
    cards = []
    for index in range(count):
        kind = PATTERN[index % len(PATTERN)]
        turn = seen[kind]
        seen[kind] += 1
        card = {"index": index, "kind": kind, "work": "mixed", "samples": 1800 if turn % 5 == 4 else 6000,
                "body": bodies.KINDS[(turn + turn // 4) % 4].name, "coloured": turn % 4 == 2, "effects": [], "sizes": []}
        if kind == "single":
            card["effects"] = [str(singles[turn % len(singles)])]
            # 18 golden steps are an eighth of the sizes' span: eight passes give each effect eight sizes, evenly.
            card["sizes"] = [_size(turn, 0.5, 50.0)]
        elif kind == "pair":
            card["effects"] = [str(name) for name in pairs[turn % len(pairs)]]
            card["sizes"] = [_size(turn, 3.0, 50.0), _size(turn + 0.5, 3.0, 50.0)]
        elif kind == "stranger":
            card["effects"], card["sizes"] = [str(strangers[turn % len(strangers)])], [_size(turn, 3.0, 50.0)]
        elif kind == "one_kind":
            card["work"], name = doubts[turn % len(doubts)]
            card["effects"], card["sizes"] = [name], [_size(turn, 3.0, 15.0)]
        cards.append(card)
    return cards
