"""The course of a run: its goals, the edges that it may use, and its plan while it is valid."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence

from .elements import Edge, Hazard, address
from .errors import PlanningError, Unavailable
from .goals import Goal, holds
from .hierarchy import Hierarchy
from .joint import JointStep
from .planner import Leg, Planner
from .stepper import Terms

PENALTY = 1e12
"""What a blocked edge costs more while the fewest of them are sought: more than any edge may."""


class Course:
    """The goals of a run and the edges that it may use. All keys are addresses of edges.

    ``shut`` are avoided or pruned, with reasons. ``risky`` have failed. ``vetoed`` are skipped
    while the run stays where they were vetoed. A route uses none of them. A person may still ask
    for a risky or a vetoed edge.
    """

    def __init__(
        self,
        hierarchy: Hierarchy,
        goals: Sequence[Goal],
        avoid: Iterable[str],
        hazards: tuple[Hazard, ...],
    ) -> None:
        self.goals, self.hazards = tuple(goals), hazards
        self.shut = dict.fromkeys(avoid, "avoided")
        self.risky: dict[str, str] = {}
        self.vetoed: dict[str, str] = {}
        self.costs: dict[str, float] = {}
        self._hierarchy = hierarchy
        self._vetoed_at: dict[str, str] = {}
        self._planners: dict[object, Planner] = {}
        self._legs: tuple[Leg, ...] = ()
        self._at = (0, 0)

    # permissions ---------------------------------------------------------------------------------

    def prune(self, edge: str, reason: str) -> None:
        """Exclude an edge until it is restored."""
        self.shut[edge] = f"pruned: {reason}" if reason else "pruned"
        self._changed()

    def restore(self, edge: str) -> bool:
        """Let an edge be used again. Return whether it was excluded, risky or vetoed."""
        known = [kept.pop(edge, None) for kept in (self.shut, self.risky, self.vetoed)]
        self._changed()
        return any(reason is not None for reason in known)

    def tag_risky(self, edge: str, reason: str) -> None:
        """Let routes avoid an edge that has failed, until it is restored."""
        self.risky[edge] = reason
        self._changed()

    def veto(self, edge: str, configuration: Mapping[str, str]) -> None:
        """Let routes avoid an edge until the run leaves this configuration."""
        if self._vetoed_at != configuration:
            self.vetoed.clear()
        self._vetoed_at = dict(configuration)
        self.vetoed[edge] = "vetoed"
        self._changed()

    def lift_vetoes(self, edges: Collection[str]) -> None:
        """Lift the vetoes of these edges, because they were skipped."""
        lifted = [self.vetoed.pop(edge, None) for edge in edges]
        if any(lifted):
            self._planners.clear()

    def set_cost(self, edge: str, cost: float, declared: float) -> dict[str, float]:
        """Set the cost of an edge. Return the costs that changed."""
        if self.costs.get(edge, declared) == cost:
            return {}
        self.costs[edge] = cost
        self._changed()
        return {edge: cost}

    @property
    def closed(self) -> dict[str, str]:
        """All edges that routes avoid, with reasons."""
        risky = {edge: f"risky: {reason}" for edge, reason in self.risky.items()}
        return {**risky, **self.vetoed, **self.shut}

    # the plan ------------------------------------------------------------------------------------

    @property
    def planner(self) -> Planner:
        """The planner with the present exclusions and costs."""
        return self._planner("now", self.closed)

    def edge(self, branch: str, state: str, name: str) -> Edge:
        """Return an edge, which must exist."""
        return self.planner.stepper.edges.get(branch, state, name)

    def asked(self, configuration: Mapping[str, str], edge: Edge) -> JointStep | Unavailable:
        """Return the joint step of an edge that a person asks for, or why there is none. The edge
        itself may be risky or vetoed, or lead into a failure state.
        """
        at = edge.address
        passed = edge.fails or at in self.risky or at in self.vetoed
        if at in self.shut or not passed:
            return self.planner.stepper.asked(configuration, edge)
        others = {one: reason for one, reason in self.closed.items() if one != at}
        planner = self._planner(at, others, failing=(at,))
        return planner.stepper.asked(configuration, edge)

    def next_step(self, configuration: Mapping[str, str]) -> tuple[JointStep | None, Leg | None]:
        """Return the next joint step, and its leg if that is new. (None, None): there is no route.

        The plan is kept while the run is where the plan expects it.
        """
        if self.vetoed and self._vetoed_at != configuration:
            self.lift_vetoes(tuple(self.vetoed))
        return self._next(configuration, self.planner)

    def _next(
        self, configuration: Mapping[str, str], planner: Planner
    ) -> tuple[JointStep | None, Leg | None]:
        legs, (leg, step), fresh = self._legs, self._at, False
        if leg < len(legs) and step == len(legs[leg].steps):
            leg, step, fresh = leg + 1, 0, True
        if leg >= len(legs) or legs[leg].before[step] != configuration:
            legs, leg, step, fresh = planner.legs(configuration, self.goals) or (), 0, 0, True
            if not legs:
                self.drop_plan()
                return None, None
        self._legs, self._at = legs, (leg, step + 1)
        return legs[leg].steps[step], legs[leg] if fresh else None

    @property
    def ahead(self) -> list[Edge]:
        """The edges of the plan after the step that was returned last."""
        leg, step = self._at
        return [
            edge
            for index in range(leg, len(self._legs))
            for joint in self._legs[index].steps[step if index == leg else 0 :]
            for edge in joint.edges
        ]

    def next_operation(self, configuration: Mapping[str, str]) -> str:
        """Return the operation that the route would begin from here, empty if there is none. The
        plan does not change.
        """
        if holds(configuration, self.goals):
            return ""
        kept = self._legs, self._at
        stale = self.vetoed and self._vetoed_at != configuration
        lasting = {edge: why for edge, why in self.closed.items() if edge not in self.vetoed}
        planner = self._planner("lasting", {**lasting, **self.shut}) if stale else self.planner
        try:
            step, _ = self._next(configuration, planner)
        except PlanningError:
            return ""
        finally:
            self._legs, self._at = kept
        return "" if step is None else step.asked.address

    def drop_plan(self) -> None:
        """Forget the plan. The next question for a step makes a new one."""
        self._legs, self._at = (), (0, 0)

    # what stands in the way ----------------------------------------------------------------------

    def blocking(self, configuration: Mapping[str, str]) -> dict[str, str]:
        """Return the fewest blocked edges whose opening would make a route, with the reasons."""
        closed = self.closed

        def reason(edge: Edge) -> str:
            """Return why no route uses an edge, or the empty text."""
            leads = f"it leads into a failure: {edge.fails}" if edge.fails else ""
            return closed.get(edge.address, leads)

        terms = Terms(
            failing=None,
            costs=self.costs,
            hazards=self.hazards,
            extra=lambda edge: PENALTY if reason(edge) else 0.0,
        )
        legs = Planner(self._hierarchy, terms).legs(configuration, self.goals)
        edges = [edge for leg in legs or () for step in leg.steps for edge in step.edges]
        return {edge.address: reason(edge) for edge in edges if reason(edge)}

    def risky_way(self, configuration: Mapping[str, str]) -> list[str]:
        """Return the risky edges on the route that would exist if no edge was risky."""
        if not self.risky:
            return []
        planner = self._planner("risky", {**self.vetoed, **self.shut})
        legs = planner.legs(configuration, self.goals)
        found = (edge for leg in legs or () for edge in leg.operations)
        return list(dict.fromkeys(edge for edge in found if edge in self.risky))

    def hazards_between(self, configuration: Mapping[str, str]) -> list[Hazard]:
        """Return the hazards on the route that would exist without any hazard."""
        if not self.hazards:
            return []
        planner = Planner(self._hierarchy, Terms(self.closed, costs=self.costs))
        legs = planner.legs(configuration, self.goals)
        meets = self._hierarchy.blueprint.meets
        met = {one.name for one in self.hazards if legs is not None and meets(one, configuration)}
        for leg in legs or ():
            for before, step in zip(leg.before, leg.steps, strict=True):
                here = dict(before)
                for action in step.actions:
                    here.update(action.moved)
                    met |= {one.name for one in self.hazards if meets(one, here)}
        return [one for one in self.hazards if one.name in met]

    # -------------------------------------------------------------------------------------------

    def _planner(
        self, what: object, shut: Mapping[str, str], failing: Collection[str] = ()
    ) -> Planner:
        """Return the planner for a question. It is kept while the terms stay."""
        if what not in self._planners:
            terms = Terms(dict(shut), failing, self.costs, self.hazards)
            self._planners[what] = Planner(self._hierarchy, terms)
        return self._planners[what]

    def _changed(self) -> None:
        self._planners.clear()
        self.drop_plan()


def goal_text(goal: Goal) -> str:
    """Return a goal as its address."""
    return address(*goal)
