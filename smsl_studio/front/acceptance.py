"""What a person must accept before a run moves, as the level of inspection says."""

from __future__ import annotations

from smsl_studio.blueprint.continuum import AUTOMATIC, HUMAN
from smsl_studio.blueprint.levels import Levels
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.inputs import inspect
from smsl_studio.inspection.rules.finding import Severity

SHOWN = 20
"""So many findings stand in a question; the others are counted."""
CLEAN = "Inspection found nothing."


def to_accept(blueprint: Blueprint, levels: Levels) -> str:
    """The findings in words; empty where nobody has to accept them.

    Level human: in any case. Shared: where there are errors or warnings. Automatic: the rules
    alone decide, by the findings that refuse a run.
    """
    if levels.inspection == AUTOMATIC:
        return ""
    grave = (Severity.ERROR, Severity.WARNING)
    found = [str(one) for one in inspect(blueprint) if one.severity in grave]
    if not found:
        return CLEAN if levels.inspection == HUMAN else ""
    more = [f"And {len(found) - SHOWN:,} more."] if len(found) > SHOWN else []
    return "\n".join((*found[:SHOWN], *more))
