"""The supervisor: whoever is asked before an operation begins, a person or an automatic agent."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import Scene

ALLOW, VETO, PRUNE, PAUSE, ASK = "allow", "veto", "prune", "pause", "ask"


@dataclass(frozen=True, slots=True)
class Proposal:
    """The partial view that a supervisor decides on: here, the operation, and what it leads to.

    ``operations`` are all edges of the joint step in the order in which they start, the one that
    was asked for last; ``risk`` is the highest declared among them (empty: none is declared).
    """

    time: float
    configuration: Mapping[str, str]
    operation: Address
    operations: tuple[Address, ...]
    target: str
    risk: str
    cost: float
    scene: Scene


@dataclass(frozen=True, slots=True)
class Verdict:
    """What a supervisor says: allow, veto (once), prune, pause, or ask a person; and why."""

    decision: str
    reason: str = ""


class Supervisor(Protocol):
    """Asked last, after every other guard, before anything moves. ``name`` stands in the record.

    It must answer at once: who needs to think answers ``ask`` or ``pause``.
    """

    @property
    def name(self) -> str:
        """The name that stands in the record of the run."""

    def review(self, proposal: Proposal) -> Verdict:
        """Decide on an operation that is proposed; called once before it begins."""
