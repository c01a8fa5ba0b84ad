"""The admission of a proposed step: facts from people, guards, the supervisor, and consent.

They come in this order, and each only if those before agree. Nothing moves before all have agreed.
If people were asked, the guards are checked again, because time has passed. Every function returns
why the step was refused at once. The text is empty if the step begins or if people are asked.
"""

from __future__ import annotations

from collections.abc import Sequence

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.continuum import HUMAN, SHARED
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.dispatch.drive.conduct import Conduct
from smsl_studio.dispatch.drive.loop_guard import LoopGuard
from smsl_studio.dispatch.drive.review import Reviewer
from smsl_studio.dispatch.drive.supervisor import (
    ALLOW,
    ASK,
    HOLD,
    PAUSE,
    PRUNE,
    TAKE_OVER,
    Verdict,
)
from smsl_studio.dispatch.execution.desk import Desk, no_words, who_words
from smsl_studio.dispatch.execution.guards import refusals
from smsl_studio.dispatch.execution.hazard_guard import HAZARD, objection
from smsl_studio.dispatch.execution.needed import of_step
from smsl_studio.dispatch.execution.run import LiveRun
from smsl_studio.dispatch.execution.trouble import HELD, Hold
from smsl_studio.dispatch.people.board import ANSWERED, Closed, Question
from smsl_studio.dispatch.people.questions import GO_ON, confirm_task, supervise_task
from smsl_studio.dispatch.route.course import Course
from smsl_studio.runlog.events import Commanded, OperationPruned, OperationRefused


class Admission:
    """Admits or refuses steps.

    ``proposed`` is the operation that was checked last. ``chosen`` says that a person asked for it.
    """

    def __init__(
        self,
        run: LiveRun,
        course: Course,
        desk: Desk,
        reviewer: Reviewer,
        loops: LoopGuard,
        conduct: Conduct,
    ) -> None:
        self.proposed: Address | None = None
        self.chosen = False
        self._run, self._course, self._desk = run, course, desk
        self._reviewer, self._loops, self._conduct = reviewer, loops, conduct

    def admit(self, step: JointStep, chosen: bool = False) -> str:
        """Let a step begin if everything agrees. ``chosen`` says that a person asked for it. Then
        nobody supervises the choice, and the run does not hold if it is refused.
        """
        self.proposed, self.chosen = step.asked.address, chosen
        facts = of_step(self._run, step) if self._run.people_say else ()
        return self._informed(step, chosen, facts) if facts else self._guarded(step, chosen)

    def _informed(self, step: JointStep, chosen: bool, facts: Sequence[Question]) -> str:
        """Ask people for facts first, then ask the guards."""

        def said(closed: tuple[Closed, ...]) -> None:
            """Check the guards if people have told all facts. Otherwise refuse the step."""
            no = no_words(closed)
            self._refuse(step, chosen, (no,)) if no else self._guarded(step, chosen)

        nobody = self._desk.ask(facts, said)
        return self._refuse(step, chosen, (nobody,)) if nobody else ""

    def _supervised(self, step: JointStep, why: str = "") -> str:
        """Ask a person whether a step of the route may begin. Return why nobody can be asked, if
        so.
        """

        def decided(closed: tuple[Closed, ...]) -> None:
            """Go on if the answer is yes. Otherwise do what the person has decided."""
            if closed[0].yes:
                self._confirmed(step, chosen=False)
            else:
                self._obey_people(step, closed[0])

        task = supervise_task(self._run.blueprint, step.asked.address, why)
        return self._desk.ask([task], decided)

    def _guarded(self, step: JointStep, chosen: bool) -> str:
        run = self._run
        reasons = (self._course.barred and self._barred(step)) or refusals(run, step)
        if reasons or (run.hazards and self._endangers(step)):
            return self._refuse(step, chosen, reasons)
        if chosen:
            objection = self._reviewer.objection(run, step)
            if objection:
                return self._refuse(step, chosen, (objection,))
            return self._confirmed(step, chosen, fresh=True)
        circling = self._loops.why_not(run.configuration, step.asked)
        if circling:
            self._course.drop_plan()
            self._conduct.hold(Hold(circling))
            return circling
        verdict = self._reviewer.verdict(run, step)
        if verdict.decision != ALLOW:
            self._obey_supervisor(step, verdict)
            if not self._desk.busy:
                self._course.drop_plan()
            return ""
        if run.levels.supervision != HUMAN:
            if run.people_act:
                return self._confirmed(step, chosen, fresh=True)
            self._conduct.begin(step, chosen)
            return ""
        nobody = self._supervised(step)
        return self._refuse(step, chosen, (nobody,)) if nobody else ""

    def _confirmed(self, step: JointStep, chosen: bool, fresh: bool = False) -> str:
        """Ask for all confirmations of a step before anything moves. Then it begins.

        ``fresh`` says that the guards were checked at this moment.
        """
        run = self._run
        asks = run.people_act and not run.unconfirmed
        questions = confirmations(run, step) if asks else ()
        if questions:
            return self._consented(step, chosen, questions)
        if not fresh:
            return self._begin(step, chosen)
        self._conduct.begin(step, chosen)
        return ""

    def _consented(self, step: JointStep, chosen: bool, questions: Sequence[Question]) -> str:
        """Ask people whether the step may begin."""

        def said(closed: tuple[Closed, ...]) -> None:
            """Begin the step if everybody has agreed. Otherwise refuse it."""
            no = no_words(closed)
            self._refuse(step, chosen, (no,)) if no else self._begin(step, chosen)

        nobody = self._desk.ask(questions, said)
        return self._refuse(step, chosen, (nobody,)) if nobody else ""

    def _begin(self, step: JointStep, chosen: bool) -> str:
        """Begin a step if the guards still agree."""
        reasons = self._barred(step) or refusals(self._run, step)
        if reasons or self._endangers(step):
            return self._refuse(step, chosen, reasons)
        self._conduct.begin(step, chosen)
        return ""

    def _barred(self, step: JointStep) -> tuple[str, ...]:
        """Return the edges of the step that were excluded after it was planned, as sentences."""
        shut = self._course.barred
        if not shut:
            return ()
        return tuple(f"{one} is {shut[one.address]}" for one in step.edges if one.address in shut)

    def _endangers(self, step: JointStep) -> bool:
        return objection(self._run, step) is not None

    def _refuse(self, step: JointStep, chosen: bool, reasons: tuple[str, ...]) -> str:
        """Refuse a step, for these reasons or else because of a hazard."""
        run, hazard, kind = self._run, "", HELD
        self._course.drop_plan()
        endangers = None if reasons else objection(run, step)
        if endangers is not None:
            hazard, reasons, kind = endangers.hazard, (endangers.sentence,), HAZARD
        run.emit(refusal(run.time, step.asked.address, reasons, hazard))
        if not chosen:
            self._conduct.hold(Hold(f"{step.asked} cannot begin: {reasons[0]}", reasons, kind))
        return "; ".join(reasons)

    def _obey_people(self, step: JointStep, closed: Closed) -> None:
        """Do what a person has decided against a step: skip it once, exclude it, or pause. Without
        a decision refuse the step.
        """
        run, address = self._run, step.asked.address
        if closed.outcome != ANSWERED or closed.answer is None:
            self._refuse(step, False, (no_words([closed]),))
            return
        self._course.drop_plan()
        decision, by = closed.answer.value, who_words(closed)
        assert decision != GO_ON.value, "that is a yes"
        run.emit(Commanded(t=run.time, command=decision, by=by, address=str(address)))
        if decision == PAUSE:
            self._conduct.paused_or_held(f"{by} wants a pause before {address}")
        else:
            self._skip(address, decision, "")

    def _obey_supervisor(self, step: JointStep, verdict: Verdict) -> None:
        """Do what the supervisor has decided: skip the step once, exclude it, pause, ask a person,
        or lock the automation out.
        """
        run, address = self._run, step.asked.address
        reason, name = verdict.reason, verdict.by or self._reviewer.name
        said = {"by": name, "address": str(address), "reason": reason}
        if verdict.decision == TAKE_OVER:
            self._conduct.taken_over(name, f"{name} takes over before {address}: {reason}")
            return
        if verdict.decision == HOLD:
            self._conduct.hold(Hold(f"{address} waits: {reason}"))
            return
        run.emit(Commanded(t=run.time, command=verdict.decision, **said))
        if verdict.decision == PAUSE:
            self._conduct.paused_or_held(f"{name} wants a pause before {address}: {reason}")
            return
        if verdict.decision == ASK:
            if self._supervised(step, f"{name} asks: {reason}"):
                self._conduct.hold(Hold(f"{name} asks about {address}: {reason}"))
            return
        words = f"{name} says no" + (f": {reason}" if reason else "")
        run.emit(OperationRefused(t=run.time, address=str(address), reasons=(words,)))
        self._skip(address, verdict.decision, reason)

    def _skip(self, address: Address, decision: str, reason: str) -> None:
        """Exclude an operation until it is restored, or skip it once."""
        run = self._run
        if decision == PRUNE:
            self._course.prune(address, reason)
            run.emit(OperationPruned(t=run.time, address=str(address), reason=reason))
        else:
            self._course.veto(address, run.configuration)


def refusal(
    time: float, address: Address, reasons: tuple[str, ...], hazard: str
) -> OperationRefused:
    """Return the event of a refusal at a simulated time (s). ``hazard`` is the name of the hazard
    that refuses, if one does.
    """
    code = HAZARD if hazard else ""
    return OperationRefused(t=time, address=str(address), reasons=reasons, code=code, hazard=hazard)


def confirmations(run: LiveRun, step: JointStep) -> tuple[Question, ...]:
    """Return the questions to those who must confirm the edges of a step: the roles in ``confirm``,
    or one person for a shared operation.
    """
    found = []
    for edge in step.edges:
        if edge.branch not in run.people_act:
            continue
        note = run.blueprint[edge.branch].operation_note(edge.source, edge.name)
        if note.confirm or run.levels.operation(edge.address) == SHARED:
            found.append(confirm_task(run.blueprint, edge.address))
    return tuple(found)
