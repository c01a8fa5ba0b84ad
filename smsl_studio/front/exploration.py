"""Explores the configurations of all SBs of a blueprint together."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.inputs import must_be_whole
from smsl_studio.inspection.explorer.explorer import (
    ExploredMode,
    explored_coupled,
    explored_free,
)
from smsl_studio.stop import EffortBounds

Json = Any
LIMIT = 1_000_000
"""The largest number of configurations that are stored."""


@dataclass(frozen=True)
class ExploredSpace:
    """All that can happen: ``ours`` with the SBs coupled as in a run, ``free`` without."""

    sbs: tuple[str, ...]
    ours: ExploredMode
    free: ExploredMode

    def as_json(self) -> dict[str, Json]:
        """Return it as ``explore`` writes it."""
        modes = {"ours": self.ours.as_json(), "free": self.free.as_json()}
        return {"sbs": list(self.sbs), "modes": modes}


def explore(
    blueprint: Blueprint,
    limit: int = LIMIT,
    seconds: float | None = None,
    megabytes: int | None = None,
) -> ExploredSpace:
    """Return the configurations of all SBs together (paper, FSM-G).

    They are counted twice: once with the SBs coupled as in a run, and once with every SB free. At
    most ``limit`` configurations of the coupled SBs are stored one by one. Larger spaces are
    counted as one set if possible. ``seconds`` (wall time) and ``megabytes`` (MB, memory of this
    process) limit the work, and ``ours.bound`` says which limit was met. RunRefused if the
    blueprint has no start.

    >>> found = explore(read("hfsm.json"))
    >>> found.ours.configurations, found.free.configurations
    (4, 8)
    """
    must_be_whole(blueprint)
    free = explored_free(blueprint)
    ours = explored_coupled(blueprint, limit, bounds=EffortBounds(seconds, megabytes))
    return ExploredSpace(tuple(blueprint.branches), ours, free)
