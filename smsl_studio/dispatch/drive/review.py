"""The question to the supervisor, which comes after all guards."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.drive.foresight import Foresight
from smsl_studio.dispatch.drive.risk import declared_risk, estimate, seen_facts
from smsl_studio.dispatch.drive.supervisor import (
    ALLOW,
    ASK,
    HOLD,
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
from smsl_studio.library.prediction import Prediction
from smsl_studio.library.supervisor_view import Neighbour
from smsl_studio.runlog.events import RiskEstimated

DECISIONS = (ALLOW, PAUSE, ASK, HOLD, VETO, PRUNE, TAKE_OVER)
"""All decisions, the most careful last."""
ALLOWED = Verdict(ALLOW)


class Reviewer:
    """Asks a supervisor about proposed steps. There may be none.

    If the supervisor has paused the run and a person lets it go on, the same step is not reviewed
    again. If the supervisor asks for a person's answer, the operation needs this answer to begin.
    """

    def __init__(self, supervisor: Supervisor | None, foresight: Foresight | None = None) -> None:
        self._supervisor, self._foresight = supervisor, foresight
        self._doubtful: tuple[tuple[str, ...], Address] | None = None
        self._trusted = False

    @property
    def name(self) -> str:
        """The name of the supervisor in the record, empty if there is none."""
        return "" if self._supervisor is None else self._supervisor.name

    def verdict(self, run: LiveRun, step: JointStep) -> Verdict:
        """Return the verdict on a step of the route."""
        if self._supervisor is None and self._foresight is None:
            return ALLOWED
        here = (tuple(run.configuration.values()), step.asked.address)
        trusted = self._trusted and self._doubtful == here
        self.forget()
        if trusted:
            return ALLOWED
        verdict = self._review(run, step)
        if verdict.decision in (PAUSE, HOLD):
            self._doubtful = here
        return verdict

    def objection(self, run: LiveRun, step: JointStep) -> str:
        """Return why an operation that a person asked for must not begin, or the empty text. The
        person's request already answers a supervisor that asks or wants a pause.
        """
        if self._supervisor is None and self._foresight is None:
            return ""
        verdict = self._review(run, step)
        if verdict.decision not in (VETO, PRUNE, TAKE_OVER):
            return ""
        return f"{self.name} says no" + (f": {verdict.reason}" if verdict.reason else "")

    def extend(self, blueprint: Blueprint) -> None:
        """Foresee from now on with a blueprint that has one more edge."""
        if self._foresight is not None:
            self._foresight.extend(blueprint)

    def compare(self, run: LiveRun, step: JointStep) -> None:
        """Tell whether the forecast of a step that has ended was right."""
        if self._foresight is not None:
            self._foresight.compare(run, step)

    def trust(self) -> None:
        """Note that a person lets the run go on, and knows what the supervisor said."""
        self._trusted = self._doubtful is not None

    def close(self) -> None:
        """Free what the supervisor and the simulator hold."""
        try:
            if isinstance(self._supervisor, Closing):
                self._supervisor.close()
        finally:
            if self._foresight is not None:
                self._foresight.close()

    def forget(self) -> None:
        """Forget which step the supervisor has paused, and that a person lets it go on."""
        self._doubtful, self._trusted = None, False

    def _review(self, run: LiveRun, step: JointStep) -> Verdict:
        """Return the more careful one of what the forecast and the supervisor say."""
        forecast, supervisor = None, self._supervisor
        if self._foresight is not None:
            forecast = self._foresight.look(run, step)
            first = self._foresight.verdict(run, step, forecast)
            if supervisor is None:
                return first
        else:
            first = ALLOWED
        assert supervisor is not None, "without both nobody is asked"
        said = self._supervised(supervisor, run, step, forecast)
        return max(said, first, key=lambda one: DECISIONS.index(one.decision))

    def _supervised(
        self,
        supervisor: Supervisor,
        run: LiveRun,
        step: JointStep,
        forecast: Prediction | None,
    ) -> Verdict:
        """Return the verdict of the supervisor. If it fails, or decides something unknown, a person
        is asked.
        """
        asked = proposal(run, step, forecast)
        if isinstance(supervisor, Estimating) and supervisor.estimates:
            asked = _estimated(run, step, asked)
            said = asked.estimate
            told = RiskEstimated(
                t=run.time, address=str(asked.operation), risk=said.risk, reasons=said.reasons
            )
            run.emit(told)
        try:
            verdict = supervisor.review(asked)
            if verdict.decision in DECISIONS and verdict.decision != HOLD:
                return verdict
            words = f"{verdict.decision!r} is no decision"
        except Exception as error:
            words = f"it failed, {type(error).__name__}: {error}"
        return Verdict(ASK, words)


def proposal(run: LiveRun, step: JointStep, forecast: Prediction | None = None) -> Proposal:
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
        forecast=forecast,
    )


def _estimated(run: LiveRun, step: JointStep, asked: Proposal) -> Proposal:
    """Return the same with the facts, the neighbours, the history and the estimated risk."""
    facts = seen_facts(run)
    return replace(
        asked,
        neighbours=tuple(_neighbours(run)),
        facts=facts,
        history=tuple(run.history),
        estimate=estimate(run, step, facts, asked.risk, asked.forecast),
        durations=run.durations,
        measures=run.senses.measures(),
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
