"""The question to the supervisor, which comes after all guards."""

from __future__ import annotations

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.dispatch.drive.supervisor import (
    ALLOW,
    ASK,
    PAUSE,
    PRUNE,
    VETO,
    Proposal,
    Supervisor,
    Verdict,
)
from smsl_studio.dispatch.execution.run import LiveRun

RISKS = ("", "low", "medium", "high")
DECISIONS = (ALLOW, VETO, PRUNE, PAUSE, ASK)
ALLOWED = Verdict(ALLOW)


class Reviewer:
    """Asks a supervisor about proposed steps. There may be none.

    If the supervisor has paused the run and a person lets it go on, the same step is not reviewed
    again. If the supervisor asks for a person's answer, the operation needs this answer to begin.
    """

    def __init__(self, supervisor: Supervisor | None) -> None:
        self._supervisor = supervisor
        self._doubtful: tuple[tuple[str, ...], Address] | None = None
        self._trusted = False

    @property
    def name(self) -> str:
        """The name of the supervisor in the record, empty if there is none."""
        return "" if self._supervisor is None else self._supervisor.name

    def verdict(self, run: LiveRun, step: JointStep) -> Verdict:
        """Return the verdict on a step of the route."""
        if self._supervisor is None:
            return ALLOWED
        here = (tuple(run.configuration.values()), step.asked.address)
        trusted = self._trusted and self._doubtful == here
        self.forget()
        if trusted:
            return ALLOWED
        verdict = self._review(self._supervisor, run, step)
        if verdict.decision == PAUSE:
            self._doubtful = here
        return verdict

    def objection(self, run: LiveRun, step: JointStep) -> str:
        """Return why an operation that a person asked for must not begin, or the empty text. The
        person's request already answers a supervisor that asks or wants a pause.
        """
        supervisor = self._supervisor
        if supervisor is None:
            return ""
        verdict = self._review(supervisor, run, step)
        if verdict.decision not in (VETO, PRUNE):
            return ""
        return f"{supervisor.name} says no" + (f": {verdict.reason}" if verdict.reason else "")

    def trust(self) -> None:
        """Note that a person lets the run go on, and knows what the supervisor said."""
        self._trusted = self._doubtful is not None

    def forget(self) -> None:
        """Forget which step the supervisor has paused, and that a person lets it go on."""
        self._doubtful, self._trusted = None, False

    def _review(self, supervisor: Supervisor, run: LiveRun, step: JointStep) -> Verdict:
        """Return the verdict of the supervisor. If it fails, or decides something unknown, a person
        is asked.
        """
        try:
            verdict = supervisor.review(proposal(run, step))
            if verdict.decision in DECISIONS:
                return verdict
            words = f"{verdict.decision!r} is no decision"
        except Exception as error:
            words = f"it failed, {type(error).__name__}: {error}"
        return Verdict(ASK, words)


def proposal(run: LiveRun, step: JointStep) -> Proposal:
    """Return the partial view of a step for a supervisor."""
    risks = [_risk(run, edge.address) for edge in step.edges]
    return Proposal(
        time=run.time,
        configuration=dict(run.configuration),
        operation=step.asked.address,
        operations=(*(edge.address for edge in step.edges[1:]), step.asked.address),
        target=step.asked.target,
        risk=max(risks, key=RISKS.index),
        cost=step.cost,
        scene=run.senses.scene,
    )


def _risk(run: LiveRun, address: Address) -> str:
    branch = run.blueprint[address.branch]
    return branch.operation_note(address.state, address.operation).risk or ""
