"""The findings that a person must accept before a run moves, by the level of inspection."""

from __future__ import annotations

from smsl_studio.blueprint.continuum import AUTOMATIC, HUMAN
from smsl_studio.blueprint.levels import Levels
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.inputs import inspect
from smsl_studio.inspection.rules.finding import Severity

SHOWN = 20
"""The largest number of findings in a question. The others are counted."""
MOST_LEFT_OUT = 100
"""The largest number of annotations that cannot be read and are told at the start of a run."""
CLEAN = "Inspection found nothing."


def to_accept(blueprint: Blueprint, levels: Levels) -> str:
    """Return the findings in words. The text is empty if no person has to accept them.

    At the level human a person accepts every run. At the level shared a person accepts errors and
    warnings. At the level automatic only the rules decide, by the findings that refuse a run.
    """
    if levels.inspection == AUTOMATIC:
        return ""
    grave = (Severity.ERROR, Severity.WARNING)
    found = [str(one) for one in inspect(blueprint) if one.severity in grave]
    if not found:
        return CLEAN if levels.inspection == HUMAN else ""
    more = [f"And {len(found) - SHOWN:,} more."] if len(found) > SHOWN else []
    return "\n".join((*found[:SHOWN], *more))


def left_out(blueprint: Blueprint) -> tuple[tuple[str, str], ...]:
    """Return the hazards and properties that cannot be read, as addresses with sentences.

    They refuse no run in simulation. A run begins without them and tells so in its first lines.
    """
    if not any(
        "_hazards" in one.values or "_properties" in one.values for one in blueprint.documents
    ):
        return ()
    from smsl_studio.inspection.rules.conditions import odd_hazards, odd_properties

    odd = [*odd_hazards(blueprint), *odd_properties(blueprint)]
    found = [(str(one.address), one.message) for one in odd[:MOST_LEFT_OUT]]
    if len(odd) > MOST_LEFT_OUT:
        found.append((found[0][0], f"and {len(odd) - MOST_LEFT_OUT:,} more that cannot be read"))
    return tuple(found)
