"""Goals: their order, and whether they can hold together (clause 11)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from .elements import Configuration
from .errors import RunRefused
from .hierarchy import Hierarchy

Goal = tuple[str, str]
"""An SB and the state in which it shall be."""


def holds(configuration: Configuration, goals: Sequence[Goal]) -> bool:
    """Return whether every goal holds."""
    return all(configuration[branch] == state for branch, state in goals)


def goals_of(hierarchy: Hierarchy, asked: Sequence[Goal]) -> tuple[Goal, ...]:
    """Return the goals in the order in which they are pursued: bases first, else as in the file.

    Without a goal every root goes to ACTIVATING. RunRefused if goals contradict each other.
    """
    found = dict(asked)
    _contradictions(hierarchy, found)
    if not asked:
        found = {root: hierarchy.blueprint[root].activating for root in hierarchy.roots}
    return tuple((name, found[name]) for name in _by_level(hierarchy) if name in found)


def _by_level(hierarchy: Hierarchy) -> list[str]:
    level: dict[str, int] = {}
    for name in hierarchy.order:
        level[name] = 1 + max((level[base] for base, _ in hierarchy.bases[name]), default=-1)
    return sorted(hierarchy.blueprint.branches, key=level.__getitem__)


def _contradictions(hierarchy: Hierarchy, goals: Mapping[str, str]) -> None:
    """Raise RunRefused if goals contradict each other: a digit that is on forces its sub-SB into
    ACTIVATING, and one that is off forbids it.
    """
    blueprint = hierarchy.blueprint
    forced: dict[str, tuple[bool, str]] = {}
    for name in hierarchy.order:
        active = blueprint[name].activating
        up, why = forced.get(name, (None, ""))
        if name in goals and up is not None and up != (goals[name] == active):
            raise RunRefused(f"the goal {name}/{goals[name]} cannot hold with the goal {why}")
        state = goals.get(name) or (active if up else None)
        if state is None:
            continue
        cause = f"{name}/{state}" if name in goals else why
        for digit, sub in hierarchy.subs[name]:
            on = blueprint[name].is_on(state, digit)
            if forced.setdefault(sub, (on, cause))[0] != on:
                raise RunRefused(
                    f"the goals {forced[sub][1]} and {cause} cannot hold together: "
                    f"{sub} cannot be both on and off"
                )
    if len(goals) < 2 or not all(_have_places(hierarchy, {n: s}) for n, s in goals.items()):
        return  # a single goal that can never hold is no contradiction: there is no route to it
    if not _have_places(hierarchy, goals):
        named = " and ".join(f"{name}/{state}" for name, state in goals.items())
        raise RunRefused(f"the goals {named} cannot hold together: bases and subs cannot agree")


def _have_places(hierarchy: Hierarchy, goals: Mapping[str, str]) -> bool:
    """Return whether every SB has a state left, when states that agree with no remaining state of a
    neighbour are removed until nothing changes.
    """
    blueprint = hierarchy.blueprint
    left = {
        branch.name: {goals[branch.name]} if branch.name in goals else set(branch.states)
        for branch in blueprint
    }
    shrinks = True
    while shrinks and all(left.values()):
        shrinks = False
        for name in hierarchy.order:
            for digit, sub in hierarchy.subs[name]:
                could = {hierarchy.is_active(sub, one) for one in left[sub]}
                bases = {one for one in left[name] if blueprint[name].is_on(one, digit) in could}
                on = {blueprint[name].is_on(one, digit) for one in bases}
                subs = {one for one in left[sub] if hierarchy.is_active(sub, one) in on}
                shrinks = shrinks or (bases, subs) != (left[name], left[sub])
                left[name], left[sub] = bases, subs
    return all(left.values())
