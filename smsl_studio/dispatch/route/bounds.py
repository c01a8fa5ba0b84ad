"""Lower bounds of the remaining cost, for the search over joint configurations (A*).

Each SB with a goal is looked at alone, in its own graph, with a lower bound for each edge. This is
the edge's own cost, plus the cheapest way for each sub-SB to enter or leave ACTIVATING if the edge
turns its digit. A quiet sub-SB does not move while its digit is off. So its first rise costs
exactly what its route costs from its present state. Later rises cost at least as much as from one
of the few states in which it can be left.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from math import inf

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.edges import Edge
from smsl_studio.blueprint.stepper import Stepper
from smsl_studio.graph.build import graph_of
from smsl_studio.graph.goal_tree import GoalTree
from smsl_studio.stop import heed

Key = tuple[str, ...]
Extra = Mapping[str, float]
"""For each state of a quiet sub-SB, how much more its first rise costs than the cheapest one."""


class CostBounds:
    """Lower bounds of the cost from any joint configuration to one where all ``wanted`` hold.

    ``start`` is the start of the search. ``quiet`` are the sub-SBs of which only operations that
    leave ACTIVATING are asked for. ``movers`` are all SBs that move.
    """

    def __init__(
        self,
        stepper: Stepper,
        start: Mapping[str, str],
        wanted: Sequence[Address],
        movers: Collection[str],
        quiet: Collection[str],
    ) -> None:
        self._stepper, self._start = stepper, start
        self._blueprint = stepper.hierarchy.blueprint
        self._still = frozenset(quiet) & stepper.plain
        self._loaded = self._below_loads(movers)
        self._turns: dict[tuple[str, bool], float] = {}
        at = {name: index for index, name in enumerate(stepper.hierarchy.order)}
        self._parts: list[tuple[int, Mapping[str, float], list[tuple[int, Extra]]]] = []
        for goal in wanted:
            if goal.branch not in self._loaded and goal.state in self._blueprint[goal.branch].table:
                extras = [(at[sub], extra) for sub, extra in self._extras(goal)]
                self._parts.append((at[goal.branch], self._far(goal), extras))

    def __call__(self, node: Key) -> float:
        """Return a lower bound of the remaining cost, ``inf`` if there is no way."""
        most = 0.0
        for at, far, extras in self._parts:
            found = far.get(node[at], inf)
            for sub, extra in extras:
                found += extra.get(node[sub], 0.0)
            most = max(most, found)
        return round(most, 9) if most < inf else inf

    def _below_loads(self, movers: Collection[str]) -> frozenset[str]:
        """Return the SBs that a ``load`` edge above them can set to any state without own cost."""
        hierarchy = self._stepper.hierarchy
        loaders = [
            name
            for name in movers
            if any(note.subs == "load" for note in self._blueprint[name].notes.operations.values())
        ]
        return frozenset(sub for name in loaders for sub in hierarchy.tree(name) if sub != name)

    def _far(self, goal: Address) -> Mapping[str, float]:
        """Return the lower bound of the SB's own way to its goal, for every state that has one."""
        graph = graph_of(self._blueprint[goal.branch])
        least: list[float] = []
        for state in graph.names:
            heed()
            least += map(self._least, self._stepper.edges.out(goal.branch, state))
        closed = [number for number, cost in enumerate(least) if cost == inf]
        costs = [0.0 if cost == inf else cost for cost in least]
        tree = GoalTree(graph, [graph.index[goal.state]], costs, closed)
        found = {name: tree.cost(number) for name, number in graph.index.items()}
        return {name: cost for name, cost in found.items() if cost is not None}

    def _least(self, edge: Edge) -> float:
        """Return the lower bound of a joint step with this edge, ``inf`` if there is none."""
        if self._stepper.closed(edge):
            return inf
        subs = dict(self._stepper.hierarchy.subs[edge.branch])
        turns = {(subs[digit], True) for digit in edge.rises}
        turns |= {(subs[digit], False) for digit in edge.falls}
        return edge.cost + sum(self._turn(sub, up) for sub, up in turns)

    def _turn(self, sub: str, up: bool) -> float:
        """Return the least cost for a sub-SB to enter (``up``) or leave its ACTIVATING state."""
        if sub in self._loaded:
            return 0.0
        found = self._turns.get((sub, up))
        if found is None:
            if sub in self._still:
                found = self._rise(sub) if up else self._fall(sub)
            else:
                found = min(map(self._least, self._crossings(sub, up)), default=inf)
            self._turns[sub, up] = found
        return found

    def _crossings(self, sub: str, up: bool) -> list[Edge]:
        edges, wanted = self._stepper.edges, 1 if up else -1
        found: list[Edge] = []
        for state in self._blueprint[sub].table:
            heed()
            found += (edge for edge in edges.out(sub, state) if edge.crossing == wanted)
        return found

    def _rise(self, sub: str) -> float:
        """Return the least cost of a quiet sub-SB's rise, from all states in which it may be
        left.
        """
        branch = self._blueprint[sub]
        left = {edge.target for edge in self._leaving(sub)} | {branch.initial, self._start[sub]}
        far = self._stepper.downhill(sub, branch.activating).far
        return min((far[state][0] for state in left - {branch.activating} if state in far),
                   default=inf)  # fmt: skip

    def _fall(self, sub: str) -> float:
        """Return the least cost of a quiet sub-SB's fall: to INITIAL by a base, or by its own
        operation.
        """
        branch = self._blueprint[sub]
        driven = self._stepper.downhill(sub, branch.initial).far.get(branch.activating)
        asked = [edge.cost for edge in self._leaving(sub)]
        return min([*asked, *([driven[0]] if driven else [])], default=inf)

    def _leaving(self, sub: str) -> list[Edge]:
        return [edge for edge in self._crossings(sub, False) if not self._stepper.closed(edge)]

    def _extras(self, goal: Address) -> list[tuple[str, Extra]]:
        """Return the extra costs of the first rise, for the quiet sub-SBs that the goal has on."""
        branch = self._blueprint[goal.branch]
        found: list[tuple[str, Extra]] = []
        for digit, sub in self._stepper.hierarchy.subs[goal.branch]:
            if sub not in self._still or sub in self._loaded or not branch.is_on(goal.state, digit):
                continue
            own = self._blueprint[sub]
            far = self._stepper.downhill(sub, own.activating).far
            least = self._turn(sub, True)
            states = (state for state in own.table if state != own.activating)
            extra = {state: far[state][0] - least if state in far else inf for state in states}
            found.append((sub, extra))
        return found
