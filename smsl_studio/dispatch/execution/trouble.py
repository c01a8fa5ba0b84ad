"""When things go wrong: relocalise, go on, adopt or hold (clauses 8 and 9). Nothing is undone."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.joint import JointStep
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
"""The run believes to stand at a goal, and its state check is not true."""


@dataclass(frozen=True)
class Hold:
    """Why a run cannot go on by itself; ``kind`` is one of the words above, or ``no_route``.

    ``blocking`` are the edges that stand in the way, ``skipped`` the vetoed ones that a run
    without a route has skipped.
    """

    reason: str
    details: Sequence[str] = ()
    kind: str = HELD
    blocking: tuple[Address, ...] = ()
    skipped: tuple[Address, ...] = ()

    @property
    def ends(self) -> str:
        """The reason with which the run ends where nobody is there to decide."""
        return NO_ROUTE if self.kind == NO_ROUTE else HELD


class Trouble:
    """Brings a run back to a configuration that the scene confirms, or says why it must hold.

    ``candidates`` are the configurations the scene agreed with when it was last asked.
    """

    def __init__(self, run: LiveRun, course: Course, adopts: bool) -> None:
        self.candidates: tuple[Mapping[str, str], ...] = ()
        self._run = run
        self._course = course
        self._adopts = adopts

    def forget(self) -> None:
        """The run holds no longer: what the scene agreed with then is no offer."""
        self.candidates = ()

    def blame(self, step: JointStep, failure: StepFailure) -> None:
        """An operation failed: tag it and the root's edge risky."""
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
        """Relocalise after a failure: by the sub alone where that explains the scene. Where the
        step lost what it rests on, the run holds, whatever the scene says."""
        run = self._run
        if failure.lost:
            return self.lost(failure.lost, failure.reason)
        if not failure.pending and not stands(run, run.configuration):
            alone = sub_relocalised(run, failure.edge.branch)
            if alone is not None:
                self.adopt(alone)
                return None
        return self.relocalise(failure.reason)

    def lost(self, facts: Sequence[str], cause: str = "") -> Hold:
        """Facts on which the run rests are false or unknown: it holds, and nothing is adopted."""
        found = self.relocalise(adopts=False)
        details = dict.fromkeys((*facts, *(found.details if found else ())))
        return Hold(cause or "; ".join(facts), tuple(details), GUARD_LOST)

    def unconfirmed(self, goals: Sequence[Address]) -> Hold | None:
        """The run stands at goals, as it believes, and the scene does not show it."""
        found = self.relocalise()
        checks = [self._run.check(goal.branch, goal.state) for goal in goals]
        failed = [check for check in checks if check.truth is not True]
        if found is None or not failed:
            return found
        words = "; ".join(check_words(self._run.blueprint, check) for check in failed)
        return replace(found, reason=f"The goal is not confirmed: {words}", kind=GOAL_UNCONFIRMED)

    def relocalise(self, cause: str = "", adopts: bool = True) -> Hold | None:
        """Read the scene: go on where it equals what is committed, else adopt or hold. ``adopts``
        False: nothing is adopted, whatever the run was told to do."""
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
            and len(self.candidates) == 1
            and stands(run, self.candidates[0])
        ):
            self.adopt(self.candidates[0])
            return None
        first = next(check for check in checks if check.truth is not True)
        return Hold(cause or check_words(run.blueprint, first), facts)

    def adopt(self, configuration: Mapping[str, str]) -> None:
        """Go on from a configuration that the scene agrees with."""
        run, self.candidates = self._run, ()
        run.relocate(configuration)
        self._course.drop_plan()
        run.emit(Relocalised(t=run.time, configuration=dict(run.configuration)))

    def no_way(self, details: Sequence[str]) -> Hold:
        """Nothing leads on: name the risky edges that would, else all that stands in the way."""
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
        skipped = tuple(course.vetoed)
        return Hold(f"{sentence}.", (*words, *details), NO_ROUTE, tuple(blocking), skipped)

    def _blocking(self) -> Mapping[Address, str]:
        try:
            return self._course.blocking(self._run.configuration)
        except PlanningError:
            return {}
