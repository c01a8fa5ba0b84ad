"""The supervisor: an agent that is asked before every operation, after all guards."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from logging import getLogger
from typing import Protocol

from .joint import JointStep
from .live import LiveRun

logger = getLogger(__name__)
ALLOW, VETO, PRUNE, PAUSE, ASK = DECISIONS = ("allow", "veto", "prune", "pause", "ask")
RISKS = ("low", "medium", "high")


@dataclass(frozen=True)
class Proposal:
    """What a supervisor sees: where the run stands, and the step that it proposes."""

    time: float
    configuration: Mapping[str, str]
    operation: str
    operations: tuple[str, ...]
    risk: str
    cost: float


@dataclass(frozen=True)
class Verdict:
    """A decision (allow, veto, prune, pause or ask), and why."""

    decision: str
    reason: str = ""


class Supervisor(Protocol):
    """It must answer at once. If it needs time, it answers ``ask`` or ``pause``."""

    name: str

    def review(self, proposal: Proposal) -> Verdict:
        """Decide on a proposed operation."""


class RiskLimit:
    """The agent of the level ``automatic``: it allows declared risks up to medium."""

    name = "risk limit medium"

    def review(self, proposal: Proposal) -> Verdict:
        """Allow, veto, or ask where no risk is declared."""
        if proposal.risk not in RISKS:
            return Verdict(ASK, f"No risk is declared for {proposal.operation}.")
        if proposal.risk == "high":
            return Verdict(VETO, "Its risk is high, above the limit of medium.")
        return Verdict(ALLOW, f"Its risk is {proposal.risk}.")


class Reviewer:
    """Asks the supervisor, if there is one.

    If it has paused the run and a person lets it go on, the same step is not reviewed again.
    """

    def __init__(self, supervisor: Supervisor | None) -> None:
        self._supervisor = supervisor
        self._doubtful: object = None
        self._trusted = False

    @property
    def name(self) -> str:
        """The name of the supervisor in the log."""
        return self._supervisor.name if self._supervisor else ""

    def verdict(self, run: LiveRun, step: JointStep) -> Verdict:
        """Return the verdict on a step of the route."""
        here = (tuple(run.configuration.values()), step.asked.address)
        trusted = self._trusted and self._doubtful == here
        self.forget()
        if self._supervisor is None or trusted:
            return Verdict(ALLOW)
        verdict = self._review(self._supervisor, run, step)
        if verdict.decision == PAUSE:
            self._doubtful = here
        return verdict

    def objection(self, run: LiveRun, step: JointStep) -> str:
        """Return why an operation that a person asked for must not begin."""
        if self._supervisor is None:
            return ""
        verdict = self._review(self._supervisor, run, step)
        if verdict.decision not in (VETO, PRUNE):
            return ""
        return f"{self.name} says no" + (f": {verdict.reason}" if verdict.reason else "")

    def trust(self) -> None:
        """Note that a person lets the run go on, and knows what the supervisor said."""
        self._trusted = self._doubtful is not None

    def forget(self) -> None:
        """Forget which step was paused."""
        self._doubtful, self._trusted = None, False

    def _review(self, supervisor: Supervisor, run: LiveRun, step: JointStep) -> Verdict:
        risks = [edge.terms.risk for edge in step.edges]
        proposal = Proposal(
            run.time,
            dict(run.configuration),
            step.asked.address,
            (*(edge.address for edge in step.edges[1:]), step.asked.address),
            max(risks, key=["", *RISKS].index),
            step.cost,
        )
        try:
            verdict = supervisor.review(proposal)
        except Exception as error:
            logger.debug("the supervisor failed", exc_info=True)
            return Verdict(ASK, f"it failed, {type(error).__name__}: {error}")
        if verdict.decision in DECISIONS:
            return verdict
        return Verdict(ASK, f"{verdict.decision!r} is no decision")
