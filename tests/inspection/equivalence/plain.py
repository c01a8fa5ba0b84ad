"""Transition systems by plain steps, and a plain bisimulation of them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from tests.inspection.proof.brute import Brute

Rows = list[list[tuple[str, int]]]
System = tuple[list[Any], Rows]
"""The facts of each node, and its labels with where they lead. Node 0 is the start."""


Label = Callable[[str, str], str]
"""Gives the label of an operation of an SB."""


def naive_system(
    plain: dict[str, Any], start: dict[str, str], label: Label | None = None
) -> System:
    """The transition system of a blueprint, by steps that share no code with the program."""
    named = label or (lambda sb, name: f"{sb}.{name}" if len(plain) > 1 else name)
    brute = Brute(plain, start)
    number = {brute.key(one): at for at, one in enumerate(brute.configs)}
    facts, rows = [], []
    for here in brute.configs:
        facts.append(tuple((sb, here[sb][1:]) for sb in sorted(plain)))
        row = []
        for sb in plain:
            for name, _ in brute.naive.edges(sb, here[sb]):
                carried = brute.naive.carry(here, sb, name, {})
                if carried is not None:
                    row.append((named(sb, name), number[brute.key(carried[0])]))
        rows.append(row)
    return facts, rows


def bisimilar(one: System, other: System) -> bool:
    """The greatest bisimulation, by taking out pairs until nothing changes."""
    pairs = {
        (a, b)
        for a, facts in enumerate(one[0])
        for b, others in enumerate(other[0])
        if facts == others
    }

    def fits(a: int, b: int) -> bool:
        return all(
            any(label == name and (x, y) in pairs for name, y in other[1][b])
            for label, x in one[1][a]
        ) and all(
            any(label == name and (x, y) in pairs for name, x in one[1][a])
            for label, y in other[1][b]
        )

    while wrong := {pair for pair in pairs if not fits(*pair)}:
        pairs -= wrong
    return (0, 0) in pairs


def after(system: System, path: tuple[str, ...]) -> set[int]:
    """Where a run leads."""
    here = {0}
    for label in path:
        here = {target for node in here for name, target in system[1][node] if name == label}
    return here


def told_apart(one: System, other: System, path: tuple[str, ...]) -> bool:
    """Whether two deterministic systems differ at the end of a run, and not before."""
    for end in range(len(path)):
        if not (after(one, path[:end]) and after(other, path[:end])):
            return False
    ends = after(one, path), after(other, path)
    if not (ends[0] and ends[1]):
        return bool(ends[0] or ends[1])
    ((a,), (b,)) = ends
    return bool(one[0][a] != other[0][b])
