"""Updates of costs and guards: the functions of the plugin are asked when the run has moved and
when facts have changed."""

from __future__ import annotations

from smsl_studio.blueprint.address import fact_text
from smsl_studio.dispatch.execution.run import LiveRun
from smsl_studio.dispatch.route.course import Course
from smsl_studio.runlog.events import CostsChanged


class PriceUpdates:
    """Asks the cost functions and guards, and gives what has changed to the course."""

    def __init__(self, run: LiveRun, course: Course) -> None:
        self._run, self._course = run, course
        self._seen: object = None
        self._told = 0
        self._faults: set[str] = set()

    def forget(self) -> None:
        """Ask again at the next opportunity: there is an edge that was not asked about."""
        self._seen = None

    def ask(self) -> None:
        """Ask the functions if something has changed since the last time. Tell the edges with new
        costs, and those that a guard closes or opens. A guard sees the whole world, so guards are
        asked every tenth of a second at least.
        """
        run = self._run
        guarded = run.opened.guarded
        if not (run.opened.priced or guarded):
            return
        readings = run.senses.scene.readings
        scene = {fact_text(*key): reading.value for key, reading in readings.items()}
        seen = (scene, len(run.history), int(run.time * 10) if guarded else 0)
        if seen == self._seen:
            return
        priced = run.host.costs(scene, tuple(run.history[self._told :]))
        self._seen, self._told = seen, len(run.history)
        changed = self._course.adapt(priced.costs)
        faults = tuple(fault for fault in priced.faults if fault not in self._faults)
        self._faults.update(faults)
        self._course.guard(priced.closed)
        closed = {str(address): reason for address, reason in priced.closed.items()}
        if changed or faults or closed:
            costs = {str(address): cost for address, cost in changed.items()}
            run.emit(CostsChanged(t=run.time, costs=costs, faults=faults, closed=closed))
