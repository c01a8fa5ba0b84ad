"""The question to the supervisor, which comes after all guards."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.dispatch.drive.risk import declared_risk, estimate, seen_facts
from smsl_studio.dispatch.drive.supervisor import (
    ALLOW,
    ASK,
    PAUSE,
    PRUNE,
    TAKE_OVER,
    VETO,
    Closing,
    Estimating,
    Proposal,
    Supervisor,
    Verdict,
)
from smsl_studio.dispatch.execution.run import LiveRun
from smsl_studio.library.supervisor_view import Neighbour
from smsl_studio.runlog.events import RiskEstimated

DECISIONS = (ALLOW, VETO, PRUNE, PAUSE, ASK, TAKE_OVER)
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
        if verdict.decision not in (VETO, PRUNE, TAKE_OVER):
            return ""
        return f"{supervisor.name} says no" + (f": {verdict.reason}" if verdict.reason else "")

    def trust(self) -> None:
        """Note that a person lets the run go on, and knows what the supervisor said."""
        self._trusted = self._doubtful is not None

    def close(self) -> None:
        """Free what the supervisor holds."""
        if isinstance(self._supervisor, Closing):
            self._supervisor.close()

    def forget(self) -> None:
        """Forget which step the supervisor has paused, and that a person lets it go on."""
        self._doubtful, self._trusted = None, False

    def _review(self, supervisor: Supervisor, run: LiveRun, step: JointStep) -> Verdict:
        """Return the verdict of the supervisor. If it fails, or decides something unknown, a person
        is asked.
        """
        asked = proposal(run, step)
        if isinstance(supervisor, Estimating) and supervisor.estimates:
            asked = _estimated(run, step, asked)
            said = asked.estimate
            told = RiskEstimated(
                t=run.time, address=str(asked.operation), risk=said.risk, reasons=said.reasons
            )
            run.emit(told)
        try:
            verdict = supervisor.review(asked)
            if verdict.decision in DECISIONS:
                return verdict
            words = f"{verdict.decision!r} is no decision"
        except Exception as error:
            words = f"it failed, {type(error).__name__}: {error}"
        return Verdict(ASK, words)


def proposal(run: LiveRun, step: JointStep) -> Proposal:
    """Return the partial view of a step for a supervisor, without what only an estimate needs."""
    return Proposal(
        time=run.time,
        configuration=dict(run.configuration),
        operation=step.asked.address,
        operations=(*(edge.address for edge in step.edges[1:]), step.asked.address),
        target=step.asked.target,
        risk=declared_risk(run, step),
        cost=step.cost,
        scene=run.senses.scene,
    )


def _estimated(run: LiveRun, step: JointStep, asked: Proposal) -> Proposal:
    """Return the same with the facts, the neighbours, the history and the estimated risk."""
    facts = seen_facts(run)
    return replace(
        asked,
        neighbours=tuple(_neighbours(run)),
        facts=facts,
        history=tuple(run.history),
        estimate=estimate(run, step, facts, asked.risk),
    )


def _neighbours(run: LiveRun) -> Iterator[Neighbour]:
    """Yield all operations out of the active states, in the order of the file."""
    for name, state in run.configuration.items():
        branch = run.blueprint[name]
        for operation, target in branch.table[state].items():
            note = branch.operation_note(state, operation)
            cost = 1.0 if note.cost is None else note.cost
            address = str(Address(name, state, operation))
            yield Neighbour(address, target, cost, note.risk or "")
