"""Failures: the run relocalises, and then goes on, adopts a configuration or holds (clauses 8 and
9). Nothing is undone.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.hazards import GuardHazard, named
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.dispatch.execution.hazard_guard import HAZARD, met, met_words
from smsl_studio.dispatch.execution.recovery import candidates, stands, sub_relocalised
from smsl_studio.dispatch.execution.run import LiveRun
from smsl_studio.dispatch.execution.stage import StepFailure
from smsl_studio.dispatch.execution.words import all_words, check_words
from smsl_studio.dispatch.route.course import Course
from smsl_studio.dispatch.route.planner import holds
from smsl_studio.errors import PlanningError
from smsl_studio.runlog.events import Mismatch, OperationRisky, Relocalised
from smsl_studio.runlog.phase import NO_ROUTE

HELD = "held"
GUARD_LOST = "guard_lost"
"""A critical fact, or one that a running operation requires, is false or unknown."""
GOAL_UNCONFIRMED = "goal_unconfirmed"
"""The run believes that it is at a goal, but the goal's state check is not true."""


@dataclass(frozen=True)
class Hold:
    """Why a run cannot go on by itself. ``kind`` is one of the words above, or ``no_route``.

    ``blocking`` are the edges that close the way to the goal. ``skipped`` are the vetoed edges of a
    run without a route.
    """

    reason: str
    details: Sequence[str] = ()
    kind: str = HELD
    blocking: tuple[Address, ...] = ()
    skipped: tuple[Address, ...] = ()

    @property
    def ends(self) -> str:
        """The reason for the end of the run if nobody is there to decide."""
        return NO_ROUTE if self.kind == NO_ROUTE else HELD


class Trouble:
    """Brings a run back to a configuration that the scene confirms, or says why it must hold.

    ``candidates`` are the configurations that fitted the scene at the last look.
    """

    def __init__(self, run: LiveRun, course: Course, adopts: bool) -> None:
        self.candidates: tuple[Mapping[str, str], ...] = ()
        self._run = run
        self._course = course
        self._adopts = adopts

    def forget(self) -> None:
        """Forget the candidates, because the run does not hold any more."""
        self.candidates = ()

    def blame(self, step: JointStep, failure: StepFailure) -> None:
        """Tag the failed operation and the edge of the root as risky, if the operation is to
        blame.
        """
        run = self._run
        if failure.risky:
            roots = [edge for edge in step.edges if edge.branch in run.hierarchy.roots]
            for edge in dict.fromkeys((failure.edge, *roots)):
                self._course.tag_risky(edge.address, failure.reason)
                run.blame(edge)
                run.emit(OperationRisky(t=run.time, address=str(edge), reason=failure.reason))
        self._course.drop_plan()
        run.drop_pending()

    def after(self, failure: StepFailure) -> Hold | None:
        """Relocalise after a failure. If a move of the sub-SB alone explains the scene, it is
        adopted. If the step has lost needed facts, the run holds whatever the scene shows.
        """
        run = self._run
        if failure.hazards:
            return self.lost(failure.lost, failure.reason, HAZARD)
        if failure.lost:
            return self.lost(failure.lost, failure.reason)
        if not failure.pending and not stands(run, run.configuration):
            alone = sub_relocalised(run, failure.edge.branch)
            if alone is not None:
                self.adopt(alone)
                return None
        return self.relocalise(failure.reason)

    def lost(self, facts: Sequence[str], cause: str = "", kind: str = GUARD_LOST) -> Hold:
        """Return a hold for needed facts that are false or unknown. Nothing is adopted."""
        found = self.relocalise(adopts=False)
        details = dict.fromkeys((*facts, *(found.details if found else ())))
        return Hold(cause or "; ".join(facts), tuple(details), kind)

    def endangered(self, hazards: Sequence[GuardHazard], observes: bool) -> Hold:
        """Return a hold for hazards that are met. Nothing is adopted. A run that only ``observes``
        is not located either.
        """
        facts = met_words(hazards)
        if observes:
            return Hold("; ".join(facts), facts, HAZARD)
        return self.lost(facts, kind=HAZARD)

    def unconfirmed(self, goals: Sequence[Address]) -> Hold | None:
        """Return a hold if the scene does not confirm the goals at which the run believes to be."""
        found = self.relocalise()
        checks = [self._run.check(goal.branch, goal.state) for goal in goals]
        failed = [check for check in checks if check.truth is not True]
        if found is None or not failed:
            return found
        words = "; ".join(check_words(self._run.blueprint, check) for check in failed)
        return replace(found, reason=f"The goal is not confirmed: {words}", kind=GOAL_UNCONFIRMED)

    def relocalise(self, cause: str = "", adopts: bool = True) -> Hold | None:
        """Read the scene. Go on if it confirms the committed configuration; otherwise adopt another
        one or return a hold. Without ``adopts`` nothing is adopted, whatever the terms of the run
        say.
        """
        run, self.candidates = self._run, ()
        run.drop_pending()
        run.look()
        if stands(run, run.configuration):
            run.emit(Relocalised(t=run.time, configuration=dict(run.configuration)))
            return None
        checks = run.checks(run.configuration)
        facts = tuple(
            words for c in checks for words in all_words(run.blueprint, (*c.misses, *c.unknown))
        )
        self.candidates = candidates(run)
        run.emit(Mismatch(t=run.time, facts=facts, candidates=self.candidates))
        if (
            adopts
            and self._adopts
            and not met(run)
            and len(self.candidates) == 1
            and stands(run, self.candidates[0])
        ):
            self.adopt(self.candidates[0])
            return None
        first = next(check for check in checks if check.truth is not True)
        return Hold(cause or check_words(run.blueprint, first), facts)

    def adopt(self, configuration: Mapping[str, str]) -> None:
        """Go on from a configuration that fits the scene."""
        run, self.candidates = self._run, ()
        run.relocate(configuration)
        self._course.drop_plan()
        run.emit(Relocalised(t=run.time, configuration=dict(run.configuration)))

    def no_way(self, details: Sequence[str]) -> Hold:
        """Return a hold for a run without a route. It names the risky edges that would make one, or
        else all edges that close the way.
        """
        run, course = self._run, self._course
        goal = next(one for one in course.goals if not holds(run.configuration, [one]))
        risky = course.risky_way(run.configuration)
        if risky:
            names = ", ".join(map(str, risky))
            words = [f"{edge}: {course.risky[edge]}" for edge in risky]
            return Hold(f"Only risky operations lead to {goal}: {names}.", words, HELD, risky)
        here = ", ".join(f"{name}/{state}" for name, state in run.configuration.items())
        blocking = self._blocking()
        here_too = {line.partition(":")[0] for line in details}
        words = [
            f"{edge}: stands in the way, {reason}"
            for edge, reason in blocking.items()
            if str(edge) not in here_too
        ]
        sentence = f"Nothing permitted leads from {here} to {goal}"
        if blocking:
            sentence += f"; it would with {', '.join(map(str, blocking))}"
        elif hazards := self._hazards():
            sentence += f"; it would through {named(hazards)}"
        skipped = tuple(course.vetoed)
        return Hold(f"{sentence}.", (*words, *details), NO_ROUTE, tuple(blocking), skipped)

    def _hazards(self) -> tuple[GuardHazard, ...]:
        try:
            return self._course.hazards_between(self._run.configuration)
        except PlanningError:
            return ()

    def _blocking(self) -> Mapping[Address, str]:
        try:
            return self._course.blocking(self._run.configuration)
        except PlanningError:
            return {}
