"""The size of a picture of several SBs, and the limits that follow from it."""

from __future__ import annotations

from collections.abc import Sequence

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import UsageError

MOST_PANELS = 500
"""The largest number of SBs in one picture."""

MOST_CAREFUL = 2_000
"""With more operations than this in one picture, lines are not led around nodes, and no free places
are looked for where labels could stand. The time for both grows with the square of an SB's size.
"""

MOST_LED = 400
"""With more operations than this in one SB, lines are not led around nodes. Most lines of such a
picture would pass many nodes, and a zoom would become slow.
"""


def crowd_of(blueprint: Blueprint, branches: Sequence[str]) -> int:
    """Return the number of states of these SBs, or of their operations if that is larger."""
    chosen = [blueprint[name] for name in branches]
    return max(
        sum(len(branch.table) for branch in chosen), sum(branch.edge_count for branch in chosen)
    )


def refuse_too_many(blueprint: Blueprint, branches: Sequence[str], advice: str) -> None:
    """Raise UsageError if there are more SBs than one picture can show."""
    if len(branches) > MOST_PANELS:
        name = branches[MOST_PANELS]
        raise UsageError(
            f"{len(branches):,} State Branches would be drawn, and {MOST_PANELS:,} are the most",
            blueprint.place(blueprint[name].address),
            advice,
        )
