"""Goals: which, in what order, and whether they can hold together (clause 11)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.errors import RunRefused


def goals_of(hierarchy: Hierarchy, asked: Sequence[Address]) -> tuple[Address, ...]:
    """The goals in the order in which they are pursued; RunRefused where they contradict.

    Bases first, else in file order. Without a goal every root goes to its ACTIVATING.
    """
    blueprint = hierarchy.blueprint
    found: dict[str, str] = {}
    for goal in asked:
        if not goal.state or goal.operation:
            raise RunRefused(f"the goal {goal} is no state", advice="Name it as SB/State.")
        if found.setdefault(goal.branch, goal.state) != goal.state:
            other = f"{goal.branch}/{found[goal.branch]}"
            raise RunRefused(f"the goals {other} and {goal} cannot hold together")
    _contradictions(hierarchy, found)
    if not asked:
        found = {root: blueprint[root].activating for root in hierarchy.roots}
    return tuple(Address(name, found[name]) for name in _bases_first(hierarchy) if name in found)


def _bases_first(hierarchy: Hierarchy) -> tuple[str, ...]:
    """Every SB by its level (roots 0, a sub one below its lowest base), then in file order."""
    level: dict[str, int] = {}
    for name in hierarchy.order:
        level[name] = 1 + max((level[base] for base, _ in hierarchy.bases[name]), default=-1)
    return tuple(sorted(hierarchy.blueprint.branches, key=lambda name: level[name]))


def _contradictions(hierarchy: Hierarchy, goals: Mapping[str, str]) -> None:
    """Follow every goal down: on puts a sub in ACTIVATING, off keeps it out. Then see whether any
    states are left in which bases and subs agree with all goals."""
    blueprint = hierarchy.blueprint
    forced: dict[str, tuple[bool, str]] = {}
    for name in hierarchy.order:
        branch = blueprint[name]
        up, why = forced.get(name, (None, ""))
        if name in goals and up is not None and up != (goals[name] == branch.activating):
            raise RunRefused(f"the goal {name}/{goals[name]} cannot hold with the goal {why}")
        state = goals.get(name) or (branch.activating if up else None)
        if state is None or state not in branch.table:
            continue
        cause = f"{name}/{state}" if name in goals else why
        for digit, sub in hierarchy.subs[name]:
            on = branch.is_on(state, digit)
            if forced.setdefault(sub, (on, cause))[0] != on:
                raise RunRefused(
                    f"the goals {forced[sub][1]} and {cause} cannot hold together: "
                    f"{sub} cannot be both on and off"
                )
    if len(goals) < 2 or any(not _places(hierarchy, {n: s}) for n, s in goals.items()):
        return  # a goal that can never hold is no contradiction: nothing permitted leads there
    if not _places(hierarchy, goals):
        named = " and ".join(f"{name}/{state}" for name, state in goals.items())
        raise RunRefused(f"the goals {named} cannot hold together: bases and subs cannot agree")


def _places(hierarchy: Hierarchy, goals: Mapping[str, str]) -> bool:
    """Whether every SB is left a state, where each digit and its sub-SB must be able to agree.

    States are taken away as long as one of them agrees with nothing that is left of a neighbour.
    Every contradiction found is one; with shared subs there are some that this does not find.
    """
    blueprint = hierarchy.blueprint
    left = {
        name: {goals[name]} & set(blueprint[name].table) if name in goals else set(branch.table)
        for name, branch in blueprint.branches.items()
    }
    shrinks = True
    while shrinks and all(left.values()):
        shrinks = False
        for name in hierarchy.order:
            branch = blueprint[name]
            for digit, sub in hierarchy.subs[name]:
                active = blueprint[sub].activating
                could = {one == active for one in left[sub]}
                bases = {one for one in left[name] if branch.is_on(one, digit) in could}
                on = {branch.is_on(one, digit) for one in bases}
                subs = {one for one in left[sub] if (one == active) in on}
                shrinks = shrinks or (bases, subs) != (left[name], left[sub])
                left[name], left[sub] = bases, subs
    return all(left.values())
