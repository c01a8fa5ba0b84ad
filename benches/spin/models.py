"""Spaces of three sizes for both: coupled counters, philosophers, Hanoi, three levels of SBs.

Each has a property that holds and one that fails. States in the conditions are ``SB@State``.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import Any, NamedTuple

Json = Any


class SpinModel(NamedTuple):
    """A blueprint, and two conditions: one that never holds, and one that can hold."""

    kind: str
    words: str
    values: dict[str, Json]
    never: str
    can: str


def models() -> Iterator[SpinModel]:
    """Yield all models, the smaller ones of each kind first."""
    for count in (6, 7, 8):
        yield counters(count)
    for count in (13, 16, 18):
        yield philosophers(count)
    for count in (10, 12, 14):
        yield hanoi(count)
    for count in (5, 6, 7):
        yield levels(count)


def counters(count: int) -> SpinModel:
    """Counters from 0 to 9; the first and the last may not both have left 0."""
    names = [f"C{n}" for n in range(count)]
    values = {name: _line([f"S{n}" for n in range(10)]) for name in names}
    first, last = names[0], names[-1]
    for one, other in ((first, last), (last, first)):
        values[one]["_operations"] = {"S0/go": {"requires": {f"{other}/0": "0"}}}
    never = f"!{first}@S0 && !{last}@S0"
    can = " && ".join(f"{name}@S9" for name in names[:-1])
    return SpinModel("counters", f"{count} counters of ten", values, never, can)


def philosophers(count: int) -> SpinModel:
    """Philosophers who take the left fork, then the right one, then put both back."""
    values = {}
    for n in range(count):
        left, right = f"P{(n - 1) % count}/1", f"P{(n + 1) % count}/0"
        values[f"P{n}"] = {
            "HEADER": {"NUM_FACTS": 2, "ACTIVATING": "S11"},
            "_operations": {
                "left": {"requires": {left: "0"}}, "right": {"requires": {right: "0"}}
            },
            "S00": {"left": "S10"},
            "S10": {"right": "S11"},
            "S11": {"back": "S00"},
        }  # fmt: skip
    can = " && ".join(f"P{n}@S10" for n in range(count))
    return SpinModel("philosophers", f"{count} philosophers", values, "P0@S11 && P1@S11", can)


def hanoi(disks: int) -> SpinModel:
    """One SB of three states a disk; a disk moves if all smaller ones lie on the third peg."""
    values: dict[str, Json] = {}
    for disk in range(disks):
        table: dict[str, dict[str, str]] = {}
        notes = {}
        for peg in "abc":
            table[f"S{peg}"] = {f"to_{other}": f"S{other}" for other in "abc" if other != peg}
            for other in set("abc") - {peg}:
                (third,) = set("abc") - {peg, other}
                needs = {f"D{smaller}/0": third for smaller in range(disk)}
                notes[f"S{peg}/to_{other}"] = {"requires": needs}
        if disk == disks - 1:
            table["Sx"] = {}
        header = {"NUM_FACTS": 1, "INITIAL": "Sa", "ACTIVATING": "Sc"}
        values[f"D{disk}"] = {"HEADER": header, "_operations": notes, **table}
    can = " && ".join(f"D{disk}@Sc" for disk in range(disks))
    return SpinModel(
        "hanoi", f"Hanoi of {disks} disks, an SB each", values, f"D{disks - 1}@Sx", can
    )


def levels(count: int) -> SpinModel:
    """A root over ``count`` SBs, each over as many lines of three states."""
    middle = [f"M{n}" for n in range(count)]
    values: dict[str, Json] = {"R": _turning(middle)}
    for name in middle:
        leaves = [f"{name}L{n}" for n in range(2)]
        values[name] = _turning(leaves)
        values.update((leaf, _line([f"S{n}" for n in range(4)])) for leaf in leaves)
    never = f"R@S{'1' * count} && !M0@S11"
    return SpinModel("levels", f"three levels, {count} x 2 x 4", values, never, f"R@S{'1' * count}")


def _line(states: list[str]) -> dict[str, Json]:
    table: dict[str, dict[str, str]] = {state: {} for state in states}
    for one, other in pairwise(states):
        table[one]["go"], table[other]["back"] = other, one
    return {"HEADER": {"NUM_FACTS": 1}, **table}


def _turning(subs: list[str]) -> dict[str, Json]:
    """A base that turns its sub-SBs on one after the other."""
    count = len(subs)
    names = [f"S{'1' * n}{'0' * (count - n)}" for n in range(count + 1)]
    table: dict[str, dict[str, str]] = {name: {} for name in names}
    for one, other in pairwise(names):
        table[one]["on"], table[other]["off"] = other, one
    header = {"NUM_FACTS": count, "SUB_SBS": {name: n for n, name in enumerate(subs)}}
    return {"HEADER": header, **table}
