"""Asking the supervisor, last of all guards, and what becomes of its verdict."""

from __future__ import annotations

from typing import TYPE_CHECKING

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.dispatch.people.admission import supervised
from smsl_studio.dispatch.run import LiveRun
from smsl_studio.dispatch.supervisor import (
    ALLOW,
    ASK,
    PAUSE,
    PRUNE,
    VETO,
    Proposal,
    Supervisor,
    Verdict,
)
from smsl_studio.dispatch.trouble import Hold
from smsl_studio.runlog.events import Commanded, OperationPruned, OperationRefused

if TYPE_CHECKING:
    from smsl_studio.dispatch.driver import Driver

RISKS = ("", "low", "medium", "high")
DECISIONS = (ALLOW, VETO, PRUNE, PAUSE, ASK)


class Reviewer:
    """Puts proposals to a supervisor, who may be nobody.

    What it paused for begins without asking it again, once a person let the run go on from there.
    Where it asks for a person's answer, nothing but that answer lets the operation begin.
    """

    def __init__(self, supervisor: Supervisor | None) -> None:
        self._supervisor = supervisor
        self._doubtful: tuple[tuple[str, ...], Address] | None = None
        self._trusted = False

    def lets_begin(self, driver: Driver, step: JointStep) -> bool:
        """Whether a step of the route may begin; else its verdict has been carried out."""
        supervisor, run, address = self._supervisor, driver.run, step.asked.address
        if supervisor is None:
            return True
        here = (tuple(run.configuration.values()), address)
        if self._trusted and self._doubtful == here:
            self.forget()
            return True
        self.forget()
        verdict = self._review(supervisor, run, step)
        if verdict.decision == ALLOW:
            return True
        self._obey(driver, verdict, supervisor.name, step)
        if verdict.decision == PAUSE:
            self._doubtful = here
        return False

    def objection(self, run: LiveRun, step: JointStep) -> str:
        """Why an operation that a person asked for may not begin. Who asks back or wants a pause
        has been answered by the person's asking."""
        supervisor = self._supervisor
        if supervisor is None:
            return ""
        verdict = self._review(supervisor, run, step)
        if verdict.decision not in (VETO, PRUNE):
            return ""
        return f"{supervisor.name} says no" + (f": {verdict.reason}" if verdict.reason else "")

    def trust(self) -> None:
        """A person lets the run go on, knowing what the supervisor said."""
        self._trusted = self._doubtful is not None

    def forget(self) -> None:
        self._doubtful, self._trusted = None, False

    def _review(self, supervisor: Supervisor, run: LiveRun, step: JointStep) -> Verdict:
        """What the supervisor says; where it fails or says nothing known, a person is asked."""
        try:
            verdict = supervisor.review(proposal(run, step))
            if verdict.decision in DECISIONS:
                return verdict
            words = f"{verdict.decision!r} is no decision"
        except Exception as error:
            words = f"it failed, {type(error).__name__}: {error}"
        return Verdict(ASK, words)

    def _obey(self, driver: Driver, verdict: Verdict, name: str, step: JointStep) -> None:
        run, reason, address = driver.run, verdict.reason, step.asked.address
        said = {"by": name, "address": str(address), "reason": reason}
        run.emit(Commanded(t=run.time, command=verdict.decision, **said))
        if verdict.decision == PAUSE:
            driver.paused_or_held(f"{name} wants a pause before {address}: {reason}")
            return
        if verdict.decision == ASK:
            why = f"{name} asks: {reason}"
            if supervised(driver, step, why):
                driver.hold(Hold(f"{name} asks about {address}: {reason}"))
            return
        words = f"{name} says no" + (f": {reason}" if reason else "")
        run.emit(OperationRefused(t=run.time, address=str(address), reasons=(words,)))
        if verdict.decision == VETO:
            driver.course.veto(address, run.configuration)
        elif verdict.decision == PRUNE:
            driver.course.prune(address, reason)
            run.emit(OperationPruned(t=run.time, address=str(address), reason=reason))


def proposal(run: LiveRun, step: JointStep) -> Proposal:
    """The partial view of a step that a supervisor decides on."""
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
