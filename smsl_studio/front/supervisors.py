"""Who supervises a run where nobody was named."""

from __future__ import annotations

from smsl_studio.blueprint.continuum import AUTOMATIC
from smsl_studio.blueprint.levels import Levels
from smsl_studio.dispatch.agents import RiskLimit
from smsl_studio.dispatch.drive.supervisor import Supervisor


def supervisor_of(levels: Levels, named: Supervisor | None = None) -> Supervisor | None:
    """The supervisor that was named, else the agent that decides at the level ``automatic``.

    It allows operations of a declared risk up to medium. None where people supervise.
    """
    if named is not None:
        return named
    return RiskLimit() if levels.supervision == AUTOMATIC else None
