"""How much stands in one picture of several SBs, and how carefully it is drawn then."""

from __future__ import annotations

from collections.abc import Sequence

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import UsageError

MOST_PANELS = 500
"""So many SBs are drawn in one picture at most."""

MOST_CAREFUL = 2_000
"""In a picture of more operations than these no line is led around nodes, no label has its place
sought: that takes the square of what stands in an SB."""


def crowd_of(blueprint: Blueprint, branches: Sequence[str]) -> int:
    """How many states, or operations where they are more, these SBs have together."""
    chosen = [blueprint[name] for name in branches]
    return max(
        sum(len(branch.table) for branch in chosen), sum(branch.edge_count for branch in chosen)
    )


def refuse_too_many(blueprint: Blueprint, branches: Sequence[str], advice: str) -> None:
    """UsageError for more SBs than one picture can show, at the first that is too many."""
    if len(branches) > MOST_PANELS:
        name = branches[MOST_PANELS]
        raise UsageError(
            f"{len(branches):,} State Branches would be drawn, and {MOST_PANELS:,} are the most",
            blueprint.place(blueprint[name].address),
            advice,
        )
