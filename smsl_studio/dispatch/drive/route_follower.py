"""The next step of the route, from the plan that is kept or from a new one."""

from __future__ import annotations

from smsl_studio.blueprint.joint import JointStep
from smsl_studio.dispatch.execution.bypass import Bypasses
from smsl_studio.dispatch.execution.outlook import Outlook
from smsl_studio.dispatch.execution.price_updates import PriceUpdates
from smsl_studio.dispatch.execution.run import LiveRun
from smsl_studio.dispatch.execution.trouble import Hold, Trouble
from smsl_studio.dispatch.route.course import Course
from smsl_studio.errors import PlanningError
from smsl_studio.runlog.events import RoutePlanned
from smsl_studio.stop import restartable


class RouteFollower:
    """Follows the route of a run, and tells each new plan.

    ``outlook`` says what is possible instead, ``pricing`` asks the plugin before each step,
    and ``bypasses`` tells which sub-SBs a new plan bypasses.
    """

    def __init__(self, run: LiveRun, course: Course, trouble: Trouble) -> None:
        self.outlook = Outlook(run, course)
        self.pricing = PriceUpdates(run, course)
        self.bypasses = Bypasses(run, course)
        self._run, self._course, self._trouble = run, course, trouble

    def next(self) -> JointStep | Hold:
        """Return the next step of the route, or the reason why there is none. A search that is
        called off goes on when it is asked for again.
        """
        run, course = self._run, self._course
        if run.opened.priced or run.opened.guarded:
            self.pricing.ask()
        return course.following(run.configuration) or self._planned()

    def _planned(self) -> JointStep | Hold:
        """Return the same, if the leg of the plan is over or the run has left it."""
        run, course = self._run, self._course
        try:
            with restartable():
                step, leg = course.next_step(run.configuration)
                if step is None:
                    return self._trouble.no_way(self.outlook.details())
        except PlanningError as error:
            words = f"{error.sentence[:1].upper()}{error.sentence[1:]}."
            return Hold(words, (error.advice,))
        if leg is not None:
            operations = tuple(map(str, leg.operations))
            run.emit(RoutePlanned(t=run.time, goal=leg.aim, operations=operations, cost=leg.cost))
            self.bypasses.tell((*(edge.address for edge in step.edges), *course.ahead))
        return step
