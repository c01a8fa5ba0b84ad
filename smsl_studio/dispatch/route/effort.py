"""How much a run may ask for: facts are sensed in every tick, and every step takes a few ticks."""

from __future__ import annotations

from collections.abc import Iterable

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.errors import PlanningError, RunRefused

MOST_FACTS = 1_000
"""So many facts a run senses at most."""

MOST_CHECKED = 4_000
"""So many facts the state checks of all SBs look at together at most (see ``checked_facts``).

A chain of 88 SBs, each below the one before, reaches it. No walk down the SBs needs more of
Python's stack than that.
"""

MOST_STEPS = 5_000
"""So many steps a route of a run has at most; Hanoi with twelve disks has 4,095."""

MOST_READINGS = 300_000
"""So many facts are sensed at most in all steps of a route together."""

MOST_SWEPT = 2_500
"""So many operations are swept where nobody says how many one waits for."""

MOST_SWEPT_READINGS = 40_000
"""So many facts are checked at most in all operations of such a sweep together."""


def fact_count(blueprint: Blueprint) -> int:
    """How many facts there are: each is sensed, or believed, in every tick."""
    return sum(branch.num_facts for branch in blueprint if branch.table)


def checked_facts(hierarchy: Hierarchy) -> int:
    """How many facts the state checks of all SBs look at together.

    A fact of a sub-SB counts once for every way that leads down to it: the check of an SB asks
    those of its sub-SBs. What a run plans and a sweep carries out grows with this number.
    """
    return sum(_by_sb(hierarchy).values())


def _by_sb(hierarchy: Hierarchy) -> dict[str, int]:
    """How many facts the check of each SB looks at, itself counted as one at least."""
    found: dict[str, int] = {}
    for name in reversed(hierarchy.order):
        own = hierarchy.blueprint[name]
        below = sum(found[sub] for _, sub in hierarchy.subs[name])
        found[name] = (max(own.num_facts, 1) + below) if own.table else below
    return found


def refuse_too_large(hierarchy: Hierarchy) -> None:
    """RunRefused where a run would sense or check more facts than it may, at the SB with the most.

    Nor is a way planned over so many joint configurations.
    """
    blueprint = hierarchy.blueprint
    count = fact_count(blueprint)
    if count > MOST_FACTS:
        largest = max(blueprint, key=lambda branch: branch.num_facts)
        raise RunRefused(
            f"there are {count:,} facts, {largest.num_facts:,} of them in {_short(largest.name)}, "
            f"and a run senses {MOST_FACTS:,} at most",
            blueprint.place(Address(largest.name)),
            "Split the blueprint, or write NUM_FACTS where the names of states carry fewer.",
        )
    checked = _by_sb(hierarchy)
    if sum(checked.values()) > MOST_CHECKED:
        deepest = max(blueprint.branches, key=checked.__getitem__)
        raise RunRefused(
            f"too many ways lead down from {_short(deepest)} to sub-SBs of sub-SBs: the checks of "
            f"all states would look at more than {MOST_CHECKED:,} facts",
            blueprint.place(Address(deepest)),
            "Use fewer levels of sub-SBs, or share fewer of them.",
        )


def refuse_too_long(steps: int, facts: int) -> None:
    """PlanningError for a route of more steps than anybody would wait for."""
    most = min(MOST_STEPS, MOST_READINGS // max(facts, 1))
    if steps > most:
        raise PlanningError(
            f"the route has {steps:,} steps; with {facts:,} facts to sense {most:,} are the most",
            advice="Name a nearer goal, and go on from there.",
        )


def refuse_too_many_edges(
    hierarchy: Hierarchy, branches: Iterable[StateBranch], most: int | None
) -> None:
    """RunRefused for a sweep of more edges than anybody would wait for, at the SB where it is.

    ``most`` says how many are waited for, None: ``MOST_SWEPT``.
    """
    checked = checked_facts(hierarchy)
    allowed = min(MOST_SWEPT, MOST_SWEPT_READINGS // max(checked, 1)) if most is None else most
    count = 0
    for branch in branches:
        count += branch.edge_count
        if count > allowed:
            raise RunRefused(
                f"more than {allowed:,} operations would be swept, with {checked:,} facts to check",
                hierarchy.blueprint.place(branch.address),
                "Name some of the State Branches, or say how many operations you wait for.",
            )


def _short(name: str) -> str:
    return name if len(name) <= 60 else f"{name[:57]}..."
