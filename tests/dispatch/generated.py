"""Small random hierarchical blueprints, as plain values, from a seed."""

from __future__ import annotations

import random
from itertools import product
from typing import Any

SHAPES: tuple[dict[str, dict[str, int]], ...] = (
    {"A": {}},
    {"A": {"B": 1}, "B": {}},
    {"A": {"B": 0, "C": 1}, "B": {}, "C": {}},
    {"A": {"B": 1}, "B": {"C": 0}, "C": {}},
    {"A": {"B": 0, "C": 2}, "B": {"C": 1}, "C": {}},
    {"A": {"B": 0}, "D": {"B": 1}, "B": {}},
    {"A": {"B": 0, "D": 1}, "D": {"C": 0}, "B": {"C": 1}, "C": {}},
)


def blueprint_values(seed: int, shape: int | None = None) -> dict[str, Any]:
    """One blueprint: 1 to 3 levels, shared subs, costs, ``load`` and ``requires`` now and then."""
    dice = random.Random(seed)
    subs = SHAPES[seed % len(SHAPES) if shape is None else shape]
    facts = {
        sb: dice.randint(max([1, *(d + 1 for d in own.values())]), 3) for sb, own in subs.items()
    }
    values: dict[str, Any] = {}
    for sb, own in subs.items():
        states = ["S" + "".join(bits) for bits in product("01", repeat=facts[sb])]
        keep = [s for s in states if dice.random() < 0.85]
        states = keep if len(keep) > 1 else states
        initial = states[0] if dice.random() < 0.6 else dice.choice(states)
        activating = dice.choice([state for state in states if state != initial])
        names = [f"o{n}" for n in range(6)]
        table = {
            state: {
                name: dice.choice(states) for name in sorted(dice.sample(names, dice.randint(1, 3)))
            }
            for state in states
        }
        notes: dict[str, Any] = {}
        for name in names:
            note: dict[str, Any] = {}
            if dice.random() < 0.3:
                note["cost"] = dice.randint(0, 3)
            if own and dice.random() < 0.15:
                note["subs"] = "load"
            if dice.random() < 0.06:
                other = dice.choice(list(subs))
                note["requires"] = {f"{other}/{dice.randrange(facts[other])}": dice.choice("01")}
            if note:
                notes[name] = note
        header = {
            "INITIAL": initial,
            "ACTIVATING": activating,
            "NUM_FACTS": facts[sb],
            "SUB_SBS": own,
        }
        values[sb] = {"HEADER": header, "_operations": notes, **table}
    return values
