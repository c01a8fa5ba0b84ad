"""The supervisor: a person or an automatic agent that is asked before an operation begins."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import Scene

ALLOW, VETO, PRUNE, PAUSE, ASK = "allow", "veto", "prune", "pause", "ask"


@dataclass(frozen=True, slots=True)
class Proposal:
    """The partial view for a decision: the active states, the proposed operation and its target.

    ``operations`` are all edges of the joint step. The proposed operation comes last, the others in
    the order in which they start. ``risk`` is the highest declared risk among them, empty if none
    is declared. ``time`` is simulated seconds.
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
    """A supervisor's decision, with its reason: ``allow``, ``veto`` (once), ``prune``, ``pause`` or
    ``ask`` (a person).
    """

    decision: str
    reason: str = ""


class Supervisor(Protocol):
    """A supervisor is asked after every other guard, before anything moves.

    It must answer at once. If it needs time, it answers ``ask`` or ``pause``.
    """

    @property
    def name(self) -> str:
        """The name of the supervisor in the record of the run."""

    def review(self, proposal: Proposal) -> Verdict:
        """Decide on a proposed operation. It is called once before the operation begins."""
