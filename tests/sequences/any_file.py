"""Random small files: one to three SBs in a lossless form, which a table world can run."""

from __future__ import annotations

import json
from random import Random
from typing import Any

from tests.smsl.native_texts import native, plain
from tests.smsl.texts import written

SHAPES = (0.35, 0.6, 0.9)
"""How many of the possible operations there are: few, some, most."""


def any_file(chance: Random) -> tuple[str, str]:
    """A name and a text; some states have places in it, all of them, or none."""
    values = _values(chance)
    seed = chance.randrange(10**9)
    if chance.random() < 0.7:
        indent = chance.choice([None, 2, 4])
        plainly = chance.random() < 0.6
        text = json.dumps(values, indent=indent) + "\n" if plainly else written(values, seed)
        return "drawn.json", text
    return "drawn.smsl", native(plain(values), seed)


def _values(chance: Random) -> dict[str, Any]:
    count = chance.choice([1, 1, 2, 3])
    values = {f"SB{number}": _branch(chance) for number in range(1, count + 1)}
    for number in range(2, count + 1):
        if chance.random() < 0.7:
            base = values[f"SB{number - 1}"]
            base.setdefault("HEADER", {}).setdefault("SUB_SBS", {})[f"SB{number}"] = 0
    return values


def _branch(chance: Random) -> dict[str, Any]:
    digits = chance.choice([1, 2, 2, 3])
    names = [f"State_{number:0{digits}b}" for number in range(2**digits)]
    share = chance.choice(SHAPES)
    branch: dict[str, Any] = {}
    if chance.random() < 0.7:
        branch["HEADER"] = {"INITIAL": names[0], "NUM_FACTS": digits}
        if chance.random() < 0.6:
            branch["HEADER"]["ACTIVATING"] = chance.choice(names)
    for name in names:
        branch[name] = {}
        for digit in range(digits):
            if chance.random() < share:
                at = len("State_") + digit
                other = "1" if name[at] == "0" else "0"
                verb = "up" if other == "1" else "down"
                branch[name][f"Op_{digit}_{verb}"] = f"{name[:at]}{other}{name[at + 1 :]}"
    placed = chance.choice([0.0, 0.0, 0.4, 1.0])
    layout = {
        name: [chance.randrange(60) * 16, chance.randrange(40) * 16]
        for name in names
        if chance.random() < placed
    }
    if layout:
        branch["_layout"] = layout
    return branch
