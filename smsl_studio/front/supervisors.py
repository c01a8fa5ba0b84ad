"""The supervisor of a run: the named one, or the default of the level of supervision."""

from __future__ import annotations

from smsl_studio.blueprint.continuum import AUTOMATIC
from smsl_studio.blueprint.levels import Levels
from smsl_studio.dispatch.agents import RiskLimit
from smsl_studio.dispatch.drive.supervisor import Supervisor


def supervisor_of(levels: Levels, named: Supervisor | None = None) -> Supervisor | None:
    """Return the named supervisor, or the agent of the level ``automatic``, or None.

    The agent allows operations with a declared risk up to medium. None means that people supervise
    (paper, Supervision).
    """
    if named is not None:
        return named
    return RiskLimit() if levels.supervision == AUTOMATIC else None
