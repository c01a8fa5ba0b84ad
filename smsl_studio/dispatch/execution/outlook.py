"""What is possible now: every edge out of the active states, permitted or with reasons."""

from __future__ import annotations

from collections.abc import Iterator

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.along import Unavailable
from smsl_studio.blueprint.check import CheckResult
from smsl_studio.blueprint.edges import Edge
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.dispatch.execution.carrier import Carrier
from smsl_studio.dispatch.execution.guards import needs, refusals
from smsl_studio.dispatch.execution.hazard_guard import objection
from smsl_studio.dispatch.execution.needed import of_step
from smsl_studio.dispatch.execution.run import LiveRun
from smsl_studio.dispatch.execution.status import Possible
from smsl_studio.dispatch.route.course import Course
from smsl_studio.stop import BrokenOff, Stopped

MOST_TOLD = 200
"""The largest number of edges in the details of a run without a route."""


class Outlook:
    """Answers questions about a run and changes nothing. Answers are kept until the scene or the
    terms change.
    """

    def __init__(self, run: LiveRun, course: Course) -> None:
        self._run = run
        self._course = course
        self._key: object = None
        self._possible: tuple[Possible, ...] = ()

    def possible(self) -> tuple[Possible, ...]:
        """Return every edge out of the active states, bases first, in written order.

        It heeds the listener (see ``stop``). If it is called off and asked again, it goes on.
        """
        key = self._now()
        if key != self._key:
            route = frozenset(self._course.ahead)
            self._possible = tuple(self._one(edge, route) for edge in self._edges())
            self._key = key
        return self._possible

    def known(self) -> tuple[tuple[Possible, ...], bool]:
        """Return the same without a long search, and whether the result is complete. An edge whose
        joint step is still being searched is not permitted yet, and its reason says so.
        """
        if self._now() == self._key:
            return self._possible, True
        route, found, whole = frozenset(self._course.ahead), [], True
        for edge in self._edges():
            try:
                found.append(self._one(edge, route))
            except BrokenOff:
                raise
            except Stopped:
                found.append(self._unknown(edge))
                whole = False
        if whole:
            self._key, self._possible = self._now(), tuple(found)
        return tuple(found), whole

    def _now(self) -> object:
        """Return everything that the answers depend on."""
        run, course = self._run, self._course
        facts = tuple(reading.value for reading in run.senses.scene.readings.values())
        return tuple(run.configuration.values()), facts, course.version, course.ahead

    def _edges(self) -> Iterator[Edge]:
        edges = self._course.planner.stepper.edges
        for name in self._run.hierarchy.order:
            yield from edges.out(name, self._run.configuration[name])

    def details(self) -> tuple[str, ...]:
        """Return why each edge out of the active states does not help. Of very many edges, the
        first ones and the number of the others are told.
        """
        every = self.possible()
        told = tuple(f"{one.address}: {self._hindrance(one)}" for one in every[:MOST_TOLD])
        more = len(every) - len(told)
        return (*told, f"and {more:,} more operations") if more else told

    def _hindrance(self, one: Possible) -> str:
        """Return why an edge does not help, even if a person may ask for it."""
        if one.reasons:
            return "; ".join(one.reasons)
        closed = self._course.closed.get(one.address)
        if closed is not None:
            return f"it is {closed}"
        edge = self._course.edge(one.address)
        if edge is not None and edge.fails:
            return f"no route uses it, it leads into a failure: {edge.fails}"
        if one.address.branch not in self._movers:
            return f"possible, but no goal moves {one.address.branch}"
        return f"possible, but no way leads on from {one.target}"

    @property
    def _movers(self) -> set[str]:
        """The SBs that may move for the goals: all SBs below the roots of the goals' SBs."""
        known = self._run.hierarchy
        roots = {root for goal in self._course.goals for root in known.roots_of(goal.branch)}
        return {name for root in roots for name in known.tree(root)}

    def awaited(self, carrier: Carrier | None) -> CheckResult | None:
        """Return the next state check that decides: that of the running operation's target, else
        that of an active state.
        """
        run = self._run
        if carrier is not None:
            edge = carrier.action.edge
            return run.check(edge.branch, edge.target, carrier.action.after)
        goal = self._course.goals[0].branch if self._course.goals else run.hierarchy.order[0]
        return run.check(goal, run.configuration[goal])

    def progress(self, carrier: Carrier | None) -> float | None:
        """Return the share of its declared duration that the running operation has taken, None if
        not known.
        """
        if carrier is None or not carrier.moving:
            return None
        edge: Address = carrier.action.edge.address
        branch = self._run.blueprint[edge.branch]
        duration = branch.operation_note(edge.state, edge.operation).duration
        if not duration:
            return None
        return min(1.0, (self._run.time - carrier.since) / duration)

    def _one(self, edge: Edge, route: frozenset[Address]) -> Possible:
        run, course = self._run, self._course
        step = course.asked(run.configuration, edge)
        unavailable = isinstance(step, Unavailable)
        note = run.blueprint[edge.branch].operation_note(edge.source, edge.name)
        reasons = step.reasons if isinstance(step, Unavailable) else self._refusals(step)
        return Possible(
            address=edge.address,
            target=edge.target,
            permitted=not reasons,
            reasons=reasons,
            cost=edge.price if isinstance(step, Unavailable) else step.cost,
            on_route=edge.address in route and not unavailable,
            pruned=edge.address in course.shut,
            risky=edge.address in course.risky,
            vetoed=edge.address in course.vetoed,
            needs=tuple(needs(run, edge)),
            risk=note.risk or "",
            level=run.levels.operation(edge.address),
        )

    def _unknown(self, edge: Edge) -> Possible:
        """Return an edge whose joint step is not known yet."""
        return Possible(
            address=edge.address,
            target=edge.target,
            permitted=False,
            reasons=("its way is still being looked for",),
            cost=edge.price,
            on_route=False,
            level=self._run.levels.operation(edge.address),
        )

    def _refusals(self, step: JointStep) -> tuple[str, ...]:
        """Return why a step may not begin. A fact that people will be asked for is no reason."""
        reasons = refusals(self._run, step)
        endangers = None if reasons else objection(self._run, step)
        reasons = reasons if endangers is None else (endangers.sentence,)
        return () if reasons and of_step(self._run, step) else reasons
