"""The admission of a proposed step: facts from people, guards, the supervisor, and consent.

They come in this order, and each only if those before agree. Nothing moves before all have agreed
(clause 4). Functions return why a step was refused; the text is empty if it begins or if people are
asked.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from .course import Course
from .elements import HUMAN, SHARED
from .guards import refusals
from .hazards import objection
from .joint import JointStep
from .live import LiveRun
from .loop_guard import LoopGuard
from .needed import of_step
from .people import Desk, Task, confirm_task, no_words, supervise_task
from .supervisor import ALLOW, ASK, PAUSE, PRUNE, Reviewer, Verdict
from .trouble import HAZARD, HELD, Hold


class Conduct(Protocol):
    """The run as a whole: what one of its parts may cause."""

    def begin(self, step: JointStep, chosen: bool) -> None:
        """Carry out a step from this tick on."""

    def hold(self, hold: Hold | None) -> None:
        """Let nothing move until somebody decides."""

    def paused_or_held(self, why: str) -> None:
        """Pause, because who was asked wants so. Without attendance, hold."""


class Admission:
    """Admits or refuses steps. ``chosen`` says that a person asked for the last one."""

    def __init__(
        self,
        run: LiveRun,
        course: Course,
        desk: Desk,
        reviewer: Reviewer,
        loops: LoopGuard,
        conduct: Conduct,
    ) -> None:
        self.proposed, self.chosen = "", False
        self._run, self._course, self._desk = run, course, desk
        self._reviewer, self._loops, self._conduct = reviewer, loops, conduct

    def admit(self, step: JointStep, chosen: bool = False) -> str:
        """Let a step begin if everything agrees."""
        self.proposed, self.chosen = step.asked.address, chosen
        facts = of_step(self._run, step)
        if not facts:
            return self._guarded(step, chosen)

        def said(closed: list[Task]) -> None:
            """Ask the guards if people have told all facts."""
            no = no_words(closed)
            self._refuse(step, chosen, [no]) if no else self._guarded(step, chosen)

        nobody = self._desk.ask(facts, said)
        return self._refuse(step, chosen, [nobody]) if nobody else ""

    def _guarded(self, step: JointStep, chosen: bool) -> str:
        run = self._run
        reasons = self._barred(step) or refusals(run, step)
        if reasons or objection(run, step.asked, step.actions):
            return self._refuse(step, chosen, reasons)
        if chosen:
            no = self._reviewer.objection(run, step)
            return self._refuse(step, chosen, [no]) if no else self._confirmed(step, chosen)
        circling = self._loops.why_not(run.configuration, step.asked)
        if circling:
            self._course.drop_plan()
            self._conduct.hold(Hold(circling))
            return circling
        return self._supervised(step)

    def _supervised(self, step: JointStep) -> str:
        verdict = self._reviewer.verdict(self._run, step)
        if verdict.decision != ALLOW:
            self._obey_agent(step, verdict)
            if not self._desk.busy:
                self._course.drop_plan()
            return ""
        if self._run.levels.supervision != HUMAN:
            return self._confirmed(step, chosen=False)
        nobody = self._ask_to_go_on(step)
        return self._refuse(step, False, [nobody]) if nobody else ""

    def _ask_to_go_on(self, step: JointStep) -> str:
        """Ask a person whether a step of the route may begin."""

        def decided(closed: list[Task]) -> None:
            """Go on after a yes. Otherwise do what the person has decided."""
            if closed[0].yes:
                self._confirmed(step, chosen=False, fresh=False)
            else:
                self._obey_person(step, closed[0])

        return self._desk.ask([supervise_task(step.asked)], decided)

    def _confirmed(self, step: JointStep, chosen: bool, fresh: bool = True) -> str:
        """Ask for all confirmations before anything moves. Then the step begins."""
        levels = self._run.levels
        questions = [
            confirm_task(edge)
            for edge in step.edges
            if edge.branch in levels.people_do
            and (edge.terms.confirm or levels.operation(edge) == SHARED)
        ]
        if not questions:
            return self._begin(step, chosen, fresh)

        def said(closed: list[Task]) -> None:
            """Begin if everybody has agreed."""
            no = no_words(closed)
            self._refuse(step, chosen, [no]) if no else self._begin(step, chosen, fresh=False)

        nobody = self._desk.ask(questions, said)
        return self._refuse(step, chosen, [nobody]) if nobody else ""

    def _begin(self, step: JointStep, chosen: bool, fresh: bool) -> str:
        """Begin a step. If people were asked, time has passed, so the guards are asked again."""
        reasons = [] if fresh else self._barred(step) or refusals(self._run, step)
        if reasons or (not fresh and objection(self._run, step.asked, step.actions)):
            return self._refuse(step, chosen, reasons)
        self._conduct.begin(step, chosen)
        return ""

    def _barred(self, step: JointStep) -> list[str]:
        shut = self._course.shut
        return [f"{one} is {shut[one.address]}" for one in step.edges if one.address in shut]

    def _refuse(self, step: JointStep, chosen: bool, reasons: Sequence[str]) -> str:
        """Refuse a step, for these reasons or else because of a hazard."""
        self._course.drop_plan()
        found = None if reasons else objection(self._run, step.asked, step.actions)
        if found is not None:
            reasons = [found.sentence]
        tell_refusal(self._run, step.asked.address, reasons, found.hazard if found else "")
        if not chosen:
            kind = HAZARD if found is not None else HELD
            self._conduct.hold(Hold(f"{step.asked} cannot begin: {reasons[0]}", reasons, kind))
        return "; ".join(reasons)

    def _obey_person(self, step: JointStep, task: Task) -> None:
        if task.answer is None:
            self._refuse(step, False, [task.why])
            return
        self._course.drop_plan()
        edge, decision, by = step.asked.address, task.answer.value, task.who
        tell_command(self._run, decision, by, address=edge)
        if decision == PAUSE:
            self._conduct.paused_or_held(f"{by} wants a pause before {edge}")
        else:
            self._skip(edge, decision, "")

    def _obey_agent(self, step: JointStep, verdict: Verdict) -> None:
        run, edge, name = self._run, step.asked.address, self._reviewer.name
        tell_command(run, verdict.decision, name, address=edge, reason=verdict.reason)
        if verdict.decision == PAUSE:
            self._conduct.paused_or_held(f"{name} wants a pause before {edge}: {verdict.reason}")
        elif verdict.decision == ASK:
            if self._ask_to_go_on(step):
                self._conduct.hold(Hold(f"{name} asks about {edge}: {verdict.reason}"))
        else:
            words = f"{name} says no" + (f": {verdict.reason}" if verdict.reason else "")
            tell_refusal(run, edge, [words])
            self._skip(edge, verdict.decision, verdict.reason)

    def _skip(self, edge: str, decision: str, reason: str) -> None:
        """Exclude an operation until it is restored, or skip it once."""
        if decision == PRUNE:
            self._course.prune(edge, reason)
            self._run.tell("operation_pruned", address=edge, reason=reason)
        else:
            self._course.veto(edge, self._run.configuration)


def tell_refusal(run: LiveRun, edge: str, reasons: Sequence[str], hazard: str = "") -> None:
    """Tell that an operation was refused. ``hazard`` is the name of the hazard that refuses it."""
    more = {"code": HAZARD, "hazard": hazard} if hazard else {}
    run.tell("operation_refused", address=edge, reasons=list(reasons), **more)


def tell_command(
    run: LiveRun, command: str, by: str, address: str = "", value: str = "", reason: str = ""
) -> None:
    """Tell a command that was carried out."""
    said = {"address": address, "value": value, "reason": reason, "refused": ""}
    run.tell("commanded", command=command, by=by, **said)
