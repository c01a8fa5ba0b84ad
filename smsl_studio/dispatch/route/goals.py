"""Goals: their order, and whether they can hold together (clause 11)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.errors import RunRefused


def goals_of(hierarchy: Hierarchy, asked: Sequence[Address]) -> tuple[Address, ...]:
    """Return the goals in the order in which they are pursued. RunRefused if they contradict each
    other.

    Goals of bases come first, then file order decides. Without a goal every root goes to its
    ACTIVATING.
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
    """Return every SB by its level (0 for a root, else one more than its deepest base), then in
    file order.
    """
    level: dict[str, int] = {}
    for name in hierarchy.order:
        level[name] = 1 + max((level[base] for base, _ in hierarchy.bases[name]), default=-1)
    return tuple(sorted(hierarchy.blueprint.branches, key=lambda name: level[name]))


def _contradictions(hierarchy: Hierarchy, goals: Mapping[str, str]) -> None:
    """Raise RunRefused if goals contradict each other. A digit that is on forces its sub-SB into
    ACTIVATING, and one that is off forbids it. Then some states must be left in which bases and
    sub-SBs agree with all goals.
    """
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
        # a single goal that can never hold is no contradiction; the search will find no route
        return
    if not _places(hierarchy, goals):
        named = " and ".join(f"{name}/{state}" for name, state in goals.items())
        raise RunRefused(f"the goals {named} cannot hold together: bases and subs cannot agree")


def _places(hierarchy: Hierarchy, goals: Mapping[str, str]) -> bool:
    """Return whether every SB has a state left, if each digit must be able to agree with its
    sub-SB.

    A state is removed if no remaining state of a neighbour agrees with it, until nothing changes.
    False is always right. With shared sub-SBs, True may overlook a contradiction.
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
