"""Large hierarchies, as plain values, for the planner and its bench: more joint configurations than
anyone can walk.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import product
from typing import Any

Plain = dict[str, Any]


def ring(states: int) -> Plain:
    """An SB without sub-SBs whose states stand in a ring; each step but one can be undone."""
    table: Plain = {
        f"S_{at}": {f"Go{at}": f"S_{(at + 1) % states}"}
        | ({f"Back{at}": f"S_{at - 1}"} if at else {})
        for at in range(states)
    }
    header = {"INITIAL": "S_0", "ACTIVATING": f"S_{states - 1}", "NUM_FACTS": 1}
    return {"HEADER": header, **table}


def cube(subs: list[str]) -> Plain:
    """A base in which each digit is a sub-SB that may rise and fall at any time."""
    count = len(subs)
    table: Plain = {}
    for digits in map("".join, product("01", repeat=count)):
        table[f"State_{digits}"] = {
            f"{'UD'[int(one)]}{at}": f"State_{digits[:at]}{'10'[int(one)]}{digits[at + 1 :]}"
            for at, one in enumerate(digits)
        }
    return {"HEADER": _header(subs), **table}


def line(subs: list[str]) -> Plain:
    """A base in which the sub-SBs rise one after the other, and fall in the opposite order."""
    count = len(subs)
    names = [f"State_{'1' * on}{'0' * (count - on)}" for on in range(count + 1)]
    table: Plain = {name: {} for name in names}
    for at in range(count):
        table[names[at]][f"Up{at}"] = names[at + 1]
        table[names[at + 1]][f"Down{at + 1}"] = names[at]
    return {"HEADER": _header(subs), **table}


def _header(subs: list[str]) -> Plain:
    ends = {"INITIAL": f"State_{'0' * len(subs)}", "ACTIVATING": f"State_{'1' * len(subs)}"}
    return {**ends, "NUM_FACTS": len(subs), "SUB_SBS": {sub: at for at, sub in enumerate(subs)}}


def line_of_rings(subs: int = 64, states: int = 8) -> Plain:
    """A line over rings: 8 ** 64 joint configurations."""
    names = [f"SUB{at}" for at in range(subs)]
    return {"BASE": line(names), **{name: ring(states) for name in names}}


def cube_of_rings(subs: int = 12, states: int = 8) -> Plain:
    """A full cube over rings."""
    names = [f"SUB{at}" for at in range(subs)]
    return {"BASE": cube(names), **{name: ring(states) for name in names}}


def three_levels(middle: int = 4, low: int = 4, states: int = 3) -> Plain:
    """A cube of cubes of rings."""
    made: Plain = {"BASE": cube([f"M{at}" for at in range(middle)])}
    for at in range(middle):
        made[f"M{at}"] = cube([f"L{at}_{below}" for below in range(low)])
    for at, below in product(range(middle), range(low)):
        made[f"L{at}_{below}"] = ring(states)
    return made


def chained(subs: int = 10, states: int = 8) -> Plain:
    """A full cube over rings, each of which may begin only while the one before it is done."""
    made = cube_of_rings(subs, states)
    for at in range(1, subs):
        requires = {f"SUB{at - 1}/0": str(states - 1)}
        made[f"SUB{at}"]["_operations"] = {"Go0": {"requires": requires}}
    return made


LARGE: dict[str, Callable[[], Plain]] = {
    "64 subs of 8 states under a line": line_of_rings,
    "3 levels of 4x4x3": three_levels,
    "a cube of 12 subs of 8 states": cube_of_rings,
    "chained requires over 10 subs": chained,
}
"""The four files of the bench by name."""
