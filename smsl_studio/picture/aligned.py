"""The places of states on both sides of a difference. A state that is on both sides has one
place.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

from smsl_studio.blueprint.comparison import Difference
from smsl_studio.graph.layout import place_states
from smsl_studio.picture.shape import Point

TENTH = 0.1
"""The precision of a layout, in pixels."""


def branch_pairs(difference: Difference) -> Iterator[tuple[str, str]]:
    """Yield the names of every SB before and after. A name is empty if the SB is not on that
    side.
    """
    old = {new: name for name, new in difference.branches.items()}
    for name in difference.after.branches:
        before = old.get(name, name)
        yield before if before in difference.before.branches else "", name
    for name in difference.before.branches:
        if difference.branches.get(name, name) not in difference.after.branches:
            yield name, ""


def changed_pairs(difference: Difference) -> list[tuple[str, str]]:
    """Return the name pairs of the SBs that have a change."""
    told = (*difference.changes, *difference.fields)
    before = {change.before.branch for change in told if change.before}
    after = {change.after.branch for change in told if change.after}
    drawn = (*difference.moved, *difference.redrawn, *difference.pinned)
    after |= {address.branch for address in drawn}
    return [pair for pair in branch_pairs(difference) if pair[0] in before or pair[1] in after]


def as_drawn(difference: Difference) -> Difference:
    """Return the difference in which only those states have moved that are drawn at another place.

    If a state is placed by hand for the first time, the file gets the places of all states of its
    SB. The other states are still drawn where they were, so they have not moved.
    """
    if not difference.moved:
        return difference
    old_names = {new: old for old, new in difference.branches.items()}
    drawn: dict[str, tuple[Mapping[str, Point], Mapping[str, Point]]] = {}
    moved = []
    for address in difference.moved:
        name = address.branch
        old = old_names.get(name, name)
        if name not in drawn:
            drawn[name] = (
                place_states(difference.before[old]), place_states(difference.after[name])
            )  # fmt: skip
        former = {new: state for state, new in difference.states.get(old, {}).items()}
        (x, y), (u, v) = (
            drawn[name][0][former.get(address.state, address.state)],
            drawn[name][1][address.state],
        )
        if max(abs(x - u), abs(y - v)) > TENTH:
            moved.append(address)
    return replace(difference, moved=tuple(moved))


def places_of(
    difference: Difference, before: str, after: str
) -> tuple[Mapping[str, Point], Mapping[str, Point]]:
    """Return the places of an SB's states before and after (pixels). Places in the files count
    first.
    """
    later = place_states(difference.after[after]) if after else {}
    if not before:
        return {}, later
    renamed = difference.states.get(before, {})
    names = {name: renamed.get(name, name) for name in difference.before[before].table}
    former = {name: later[new] for name, new in names.items() if new in later}
    return place_states(difference.before[before], former), later
