"""The limits of a run. Facts are sensed in every tick, and every step takes a few ticks."""

from __future__ import annotations

from collections.abc import Iterable

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.errors import PlanningError, RunRefused

MOST_FACTS = 1_000
"""The largest number of facts that a run senses."""

MOST_CHECKED = 4_000
"""The largest number of facts that the state checks of all SBs compare (see ``checked_facts``).

A chain of 88 SBs, each below the one before, reaches it. So no recursion over SBs exceeds Python's
stack.
"""

MOST_STEPS = 5_000
"""The largest number of steps of a route. Hanoi with twelve disks has 4,095."""

MOST_READINGS = 300_000
"""The largest number of facts that are sensed in all steps of a route."""

MOST_SWEPT = 2_500
"""The largest number of operations in a sweep without a number of its own."""

MOST_SWEPT_READINGS = 40_000
"""The largest number of facts that are checked in all operations of such a sweep."""


def fact_count(blueprint: Blueprint) -> int:
    """Return the number of facts. Each is sensed or believed in every tick."""
    return sum(branch.num_facts for branch in blueprint if branch.table)


def checked_facts(hierarchy: Hierarchy) -> int:
    """Return the number of facts that the state checks of all SBs compare.

    A fact of a sub-SB counts once for every path down to it, because the check of an SB uses those
    of its sub-SBs. The work of planning and of a sweep grows with this number.
    """
    return sum(_by_sb(hierarchy).values())


def _by_sb(hierarchy: Hierarchy) -> dict[str, int]:
    """Return the number of facts that the check of each SB compares. An SB without facts counts as
    one.
    """
    found: dict[str, int] = {}
    for name in reversed(hierarchy.order):
        own = hierarchy.blueprint[name]
        below = sum(found[sub] for _, sub in hierarchy.subs[name])
        found[name] = (max(own.num_facts, 1) + below) if own.table else below
    return found


def refuse_too_large(hierarchy: Hierarchy) -> None:
    """Raise RunRefused if a run would sense or check too many facts, at the SB with the most.

    The limits also bound the planning over joint configurations.
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
    """Raise PlanningError if a route has too many steps. ``facts`` is the number of sensed
    facts.
    """
    most = min(MOST_STEPS, MOST_READINGS // max(facts, 1))
    if steps > most:
        raise PlanningError(
            f"the route has {steps:,} steps; with {facts:,} facts to sense {most:,} are the most",
            advice="Name a nearer goal, and go on from there.",
        )


def refuse_too_many_edges(
    hierarchy: Hierarchy, branches: Iterable[StateBranch], most: int | None
) -> None:
    """Raise RunRefused if a sweep has too many edges, at the SB where the limit is passed.

    ``most`` is the limit of the caller. None means ``MOST_SWEPT``.
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
