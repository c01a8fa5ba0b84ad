"""The course of a run: its goals, its excluded edges, and its plan as long as it is valid."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.along import Unavailable
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.edges import Edge
from smsl_studio.blueprint.hazards import GuardHazard
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.blueprint.terms import Terms
from smsl_studio.dispatch.route.blocks import Blocks
from smsl_studio.dispatch.route.planner import Leg, Planner, hazards_on
from smsl_studio.dispatch.route.prices import Prices
from smsl_studio.dispatch.route.ways import Ways
from smsl_studio.errors import PlanningError
from smsl_studio.host.protocol import Bound

VETOED = "vetoed"


class _Exact(Collection[Address]):
    """The edges with a function that is bound by their full address, looked up when they are asked
    for.
    """

    def __init__(self, bound: Mapping[Address, Bound]) -> None:
        self._bound = bound

    def __contains__(self, address: object) -> bool:
        found = self._bound.get(address) if isinstance(address, Address) else None
        return found is not None and found.exact

    def __iter__(self) -> Iterator[Address]:
        return (address for address, one in self._bound.items() if one.exact)

    def __len__(self) -> int:
        return sum(1 for _ in self)


class Course:
    """The goals of a run and the edges that it may use.

    ``shut`` are edges that were avoided or pruned, with reasons. ``risky`` are edges that have
    failed. ``guarded`` are edges that a guard of the plugin closes now. ``vetoed`` are edges that
    are skipped while the run stays where they were vetoed. A route uses none of them. A person may
    still ask for a risky or a vetoed edge. No route, and no operation that a person asks for, meets
    one of ``hazards``.
    """

    def __init__(
        self,
        hierarchy: Hierarchy,
        goals: Sequence[Address],
        bound: Mapping[Address, Bound],
        shut: Mapping[Address, str],
        hazards: tuple[GuardHazard, ...] = (),
    ) -> None:
        self.hazards = hazards
        self.goals = tuple(goals)
        self.shut = dict(shut)
        self.risky: dict[Address, str] = {}
        self.guarded: dict[Address, str] = {}
        self.vetoed: dict[Address, str] = {}
        self.prices = Prices(hierarchy.blueprint)
        self._ways = Ways(hierarchy)
        self.version = 0
        self._hierarchy = hierarchy
        self._bound = bound
        self._exact = _Exact(bound)
        self._planner: Planner | None = None
        self._asked: dict[Address, Planner] = {}
        self._what_if: dict[object, Planner] = {}
        self._prospect_of: tuple[object, tuple[JointStep | None, tuple[Address, ...]]]
        self._prospect_of = None, (None, ())
        self._detours: dict[object, tuple[Address, ...] | None] = {}
        self._vetoed_at: dict[str, str] = {}
        self._legs: tuple[Leg, ...] = ()
        self._at = (0, 0)
        self._ahead: tuple[Address, ...] | None = None

    # permissions --------------------------------------------------------------------------------

    def prune(self, address: Address, reason: str) -> None:
        """Exclude an edge until it is restored."""
        self.shut[address] = f"pruned: {reason}" if reason else "pruned"
        self._changed()

    def restore(self, address: Address) -> bool:
        """Let an edge be used again. Return whether it was excluded, risky or vetoed."""
        known = [kept.pop(address, None) for kept in (self.shut, self.risky, self.vetoed)]
        self._changed()
        return any(reason is not None for reason in known)

    def tag_risky(self, address: Address, reason: str) -> None:
        """Let routes avoid an edge that has failed, until it is restored."""
        self.risky[address] = reason
        self._changed()

    def veto(self, address: Address, configuration: Mapping[str, str]) -> None:
        """Let routes avoid an edge until the run leaves this configuration."""
        if self._vetoed_at != dict(configuration):
            self.vetoed.clear()
        self._vetoed_at = dict(configuration)
        self.vetoed[address] = VETOED
        self._changed()

    def guard(self, closed: Mapping[Address, str]) -> None:
        """Close edges for the reasons of their guards; an empty reason opens an edge again."""
        for address, reason in closed.items():
            if reason:
                self.guarded[address] = f"not available: {reason}"
            else:
                self.guarded.pop(address, None)
        if closed:
            self._changed()

    def set_cost(self, address: Address, cost: float) -> Mapping[Address, float]:
        """Set the cost of an edge for a person. Return the changed costs. UsageError if it is no
        valid cost.
        """
        return self._repriced(self.prices.say(address, cost))

    def adapt(self, costs: Mapping[Address, float | None]) -> Mapping[Address, float]:
        """Set the costs from cost functions; None means the declared cost. Return the changed
        costs.
        """
        return self._repriced(self.prices.adapt(costs))

    def extend(self, hierarchy: Hierarchy, bound: Mapping[Address, Bound]) -> None:
        """Plan from now on with a blueprint that has one more edge. What was shut out stays so."""
        self._hierarchy, self._bound, self._exact = hierarchy, bound, _Exact(bound)
        self._ways = Ways(hierarchy)
        self.prices.follow(hierarchy.blueprint)
        self._changed()

    # the plan ---------------------------------------------------------------------------------

    @property
    def planner(self) -> Planner:
        """The planner with the present exclusions and costs."""
        if self._planner is None:
            self._planner = self._planner_of(self.closed)
        return self._planner

    @property
    def closed(self) -> Mapping[Address, str]:
        """All edges that routes avoid, with reasons."""
        return {**self._lasting, **self.vetoed, **self.barred}

    @property
    def barred(self) -> Mapping[Address, str]:
        """The edges that nobody may begin now, with reasons."""
        return {**self.guarded, **self.shut} if self.guarded else self.shut

    @property
    def _lasting(self) -> Mapping[Address, str]:
        """The same without vetoes, which are valid only in one configuration."""
        risky = {address: f"risky: {reason}" for address, reason in self.risky.items()}
        return {**risky, **self.barred}

    def asked(self, configuration: Mapping[str, str], edge: Edge) -> JointStep | Unavailable:
        """Return the joint step of an edge that a person asks for, or why there is none. The edge
        itself may be risky or vetoed, or lead into a failure state.
        """
        address = edge.address
        passed = edge.fails or address in self.risky or address in self.vetoed
        if address in self.barred or not passed:
            return self.planner.stepper.step(configuration, edge)
        planner = self._asked.get(address)
        if planner is None:
            others = {one: reason for one, reason in self.closed.items() if one != address}
            planner = self._planner_of(others, failing=(address,))
            self._asked[address] = planner
        return planner.stepper.step(configuration, edge)

    def edge(self, address: Address) -> Edge | None:
        """Return the edge of an operation, None if there is none."""
        return self.planner.stepper.edges.get(address)

    def next_step(self, configuration: Mapping[str, str]) -> tuple[JointStep | None, Leg | None]:
        """Return the next joint step, and its leg if the leg is new.

        The plan is kept while the run is where the plan expects it. (None, None) means that no
        permitted route leads to the goals.
        """
        if self.vetoed:
            self._lift_vetoes(configuration)
        return self._next(configuration, self.planner)

    def following(self, configuration: Mapping[str, str]) -> JointStep | None:
        """Return the next joint step of the current leg.

        It is None if the leg is over, if the run does not stand where the leg has it, or if a veto
        may have to be lifted. Then ``next_step`` knows the answer.
        """
        leg, step = self._at
        if self.vetoed or leg >= len(self._legs):
            return None
        current = self._legs[leg]
        if step >= len(current.steps) or current.before[step] != configuration:
            return None
        self._at, self._ahead = (leg, step + 1), None
        return current.steps[step]

    def _next(
        self, configuration: Mapping[str, str], planner: Planner
    ) -> tuple[JointStep | None, Leg | None]:
        legs, (leg, step) = self._legs, self._at
        fresh = False
        if leg < len(legs) and step == len(legs[leg].steps):
            leg, step, fresh = leg + 1, 0, True
        if leg >= len(legs) or legs[leg].before[step] != configuration:
            legs = planner.legs(configuration, self.goals) or ()
            if not legs:
                self.drop_plan()
                return None, None
            self._legs, leg, step, fresh = legs, 0, 0, True
        self._at, self._ahead = (leg, step + 1), None
        current = legs[leg]
        return current.steps[step], current if fresh else None

    @property
    def ahead(self) -> tuple[Address, ...]:
        """The edges of the plan after the step that was returned last."""
        if self._ahead is not None:
            return self._ahead
        leg, step = self._at
        self._ahead = tuple(
            edge.address
            for index in range(leg, len(self._legs))
            for joint in self._legs[index].steps[step if index == leg else 0 :]
            for edge in joint.edges
        )
        return self._ahead

    def next_operation(self, configuration: Mapping[str, str]) -> Address | None:
        """Return the operation that the route would begin from here. The plan does not change."""
        step, _ = self._prospect(configuration)
        return None if step is None else step.asked.address

    def prospect(self, configuration: Mapping[str, str]) -> tuple[Address, ...]:
        """Return the edges of the route that would be planned from here. The plan does not
        change.
        """
        step, following = self._prospect(configuration)
        return () if step is None else (*(edge.address for edge in step.edges), *following)

    def _prospect(
        self, configuration: Mapping[str, str]
    ) -> tuple[JointStep | None, tuple[Address, ...]]:
        """Return the first step and the other edges of the route from here. No plan or veto is
        changed.
        """
        asked = (tuple(configuration.values()), self._legs, self._at, self.version)
        if self._prospect_of[0] != asked:
            self._prospect_of = asked, self._looked_ahead(configuration)
        return self._prospect_of[1]

    def _looked_ahead(
        self, configuration: Mapping[str, str]
    ) -> tuple[JointStep | None, tuple[Address, ...]]:
        kept = self._legs, self._at, self._ahead
        stale = self.vetoed and self._vetoed_at != dict(configuration)
        planner = self._under("lasting", self._lasting) if stale else self.planner
        try:
            step, _ = self._next(configuration, planner)
            return step, self.ahead
        except PlanningError:
            return None, ()
        finally:
            self._legs, self._at, self._ahead = kept

    def drop_plan(self) -> None:
        """Forget the plan. The next question for a step makes a new one."""
        self._legs, self._at, self._ahead = (), (0, 0), None

    # hypothetical questions ---------------------------------------------------------------------

    def detour(
        self, configuration: Mapping[str, str], address: Address
    ) -> tuple[Address, ...] | None:
        """Return the route to the goals if an edge was vetoed here, None if there is none.

        PlanningError if the search takes too long.
        """
        key = (tuple(configuration.values()), address)
        if key not in self._detours:
            planner = self._under(address, {**self.closed, address: VETOED})
            legs = planner.legs(configuration, self.goals)
            self._detours[key] = None if legs is None else _operations(legs)
            del self._what_if[address]
        return self._detours[key]

    def blocking(self, configuration: Mapping[str, str]) -> Mapping[Address, str]:
        """Return the fewest blocked edges whose opening would make a route, with the reasons.

        They are avoided, pruned, risky, vetoed, without a function, or lead into a failure state.
        Empty if there is a route, or if the blueprint has none at all.
        """
        blocks = Blocks(self.closed, self._bound)
        planner = self._what_if.get(Blocks)
        if planner is None:
            prices, hazards = self.prices.now, self.hazards
            terms = Terms({}, None, self._exact, None, prices, blocks, hazards)
            planner = self._what_if[Blocks] = Planner(self._hierarchy, terms, self._ways)
        legs = planner.legs(configuration, self.goals)
        edges = (edge for leg in legs or () for step in leg.steps for edge in step.edges)
        return blocks.among(edges)

    def risky_way(self, configuration: Mapping[str, str]) -> tuple[Address, ...]:
        """Return the risky edges on the route that would exist if no edge was risky. Empty if there
        is none.
        """
        if not self.risky:
            return ()
        planner = self._under("risky", {**self.vetoed, **self.barred})
        legs = planner.legs(configuration, self.goals)
        found = (edge for leg in legs or () for edge in leg.operations)
        return tuple(dict.fromkeys(edge for edge in found if edge in self.risky))

    def hazards_between(self, configuration: Mapping[str, str]) -> tuple[GuardHazard, ...]:
        """Return the hazards on the route that would exist without any hazard. Empty if there is
        none.
        """
        if not self.hazards:
            return ()
        planner = self._what_if.get(GuardHazard)
        if planner is None:
            planner = self._what_if[GuardHazard] = self._planner_of(self.closed, hazards=())
        return hazards_on(self.hazards, configuration, planner.legs(configuration, self.goals))

    def lift_vetoes(self, addresses: Collection[Address]) -> None:
        """Lift the vetoes of these edges, because they were skipped."""
        lifted = [self.vetoed.pop(address, None) for address in addresses]
        if any(lifted):
            self.version += 1
            self._forget_planners()

    def _lift_vetoes(self, configuration: Mapping[str, str]) -> None:
        if self._vetoed_at != dict(configuration):
            self.lift_vetoes(tuple(self.vetoed))

    def _repriced(self, changed: Mapping[Address, float]) -> Mapping[Address, float]:
        if changed:
            self._changed()
        return changed

    def _changed(self) -> None:
        self.version += 1
        self._forget_planners()
        self.drop_plan()

    def _forget_planners(self) -> None:
        self._planner, self._asked, self._detours, self._what_if = None, {}, {}, {}

    def _under(self, what: object, shut: Mapping[Address, str]) -> Planner:
        """Return the planner for a hypothetical question. It is kept while the terms stay, so a
        search that was called off goes on when it is asked for again.
        """
        planner = self._what_if.get(what)
        if planner is None:
            planner = self._what_if[what] = self._planner_of(shut)
        return planner

    def _planner_of(
        self,
        shut: Mapping[Address, str],
        failing: Collection[Address] = (),
        hazards: tuple[GuardHazard, ...] | None = None,
    ) -> Planner:
        guards = self.hazards if hazards is None else hazards
        prices = self.prices.now
        terms = Terms(shut, self._bound.keys(), self._exact, failing, prices, hazards=guards)
        return Planner(self._hierarchy, terms, self._ways)


def _operations(legs: Sequence[Leg]) -> tuple[Address, ...]:
    return tuple(edge for leg in legs for edge in leg.operations)
