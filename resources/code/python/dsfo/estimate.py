"""A lower bound of the cost that is left, so that a search does not walk where nothing leads on.

Each SB with a goal is looked at alone, in its own graph. An edge that turns the digit of a sub-SB
costs at least what the cheapest crossing of this sub-SB costs. A sub-SB of which nothing but a
crossing needs to be asked does not move while its digit is off: so its first rise costs exactly
what its way from where it stands costs.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from heapq import heappop, heappush
from math import inf

from .elements import Configuration, Edge
from .goals import Goal
from .search import Node
from .stepper import Stepper


class Estimate:
    """The lower bound from each joint configuration to one in which all ``wanted`` hold.

    ``quiet`` are the sub-SBs of which only operations that leave ACTIVATING are asked.
    """

    def __init__(
        self,
        stepper: Stepper,
        start: Configuration,
        wanted: Sequence[Goal],
        movers: Collection[str],
        quiet: Collection[str],
    ) -> None:
        self._stepper, self._hierarchy, self._start = stepper, stepper.hierarchy, start
        self._blueprint = stepper.blueprint
        self._still = {name for name in quiet if len(self._hierarchy.bases[name]) == 1}
        self._loaded = {
            sub
            for name in movers
            if any(terms.load for terms in self._blueprint[name].operations.values())
            for sub in self._hierarchy.tree(name)[1:]
        }
        self._turns: dict[tuple[str, bool], float] = {}
        self._parts = [
            (self._hierarchy.place[branch], self._far(branch, state), self._extras(branch, state))
            for branch, state in wanted
            if branch in movers and branch not in self._loaded
        ]

    def __call__(self, node: Node) -> float:
        """Return a lower bound of the cost that is left, ``inf`` if there is no way."""
        most = 0.0
        for at, far, extras in self._parts:
            more = sum(extra.get(node[sub], 0.0) for sub, extra in extras)
            most = max(most, far.get(node[at], inf) + more)
        return round(most, 9) if most < inf else inf

    def _far(self, branch: str, goal: str) -> dict[str, float]:
        """Return the bound of the SB's own way to a state, from every state that has one."""
        edges = self._edges(branch)
        return _spread(goal, [(edge, self._least(edge)) for edge in edges])

    def _edges(self, branch: str) -> list[Edge]:
        states = self._blueprint[branch].states
        return [edge for state in states for edge in self._stepper.edges.out(branch, state)]

    def _closed(self, edge: Edge) -> bool:
        return next(self._stepper.terms.closures(edge), None) is not None

    def _least(self, edge: Edge) -> float:
        """Return what a joint step with this edge costs at least, ``inf`` if it is closed."""
        if self._closed(edge):
            return inf
        subs = dict(self._hierarchy.subs[edge.branch])
        turned = {(subs[digit], True) for digit in edge.rises}
        turned |= {(subs[digit], False) for digit in edge.falls}
        return edge.cost + sum(self._turn(sub, up) for sub, up in turned)

    def _turn(self, sub: str, up: bool) -> float:
        """Return the least cost for a sub-SB to enter or leave its ACTIVATING state."""
        if sub in self._loaded:
            return 0.0
        if (sub, up) not in self._turns:
            if sub in self._still:
                found = self._rise(sub) if up else self._fall(sub)
            else:
                found = min(map(self._least, self._crossings(sub, 1 if up else -1)), default=inf)
            self._turns[sub, up] = found
        return self._turns[sub, up]

    # sub-SBs that stand still while their digit is off -------------------------------------------

    def _crossings(self, sub: str, crossing: int) -> list[Edge]:
        return [edge for edge in self._edges(sub) if edge.crossing == crossing]

    def _own_way(self, sub: str, up: bool) -> dict[str, float]:
        """Return what a sub-SB's own way to ACTIVATING or INITIAL costs from each state."""
        crossings = (0, 1) if up else (0, -1)
        edges = [
            (edge, edge.cost)
            for edge in self._edges(sub)
            if edge.crossing in crossings and not self._closed(edge)
        ]
        return _spread(self._hierarchy.rest(sub, up), edges)

    def _rise(self, sub: str) -> float:
        left = {edge.target for edge in self._crossings(sub, -1) if not self._closed(edge)}
        branch, far = self._blueprint[sub], self._own_way(sub, up=True)
        states = (left | {branch.initial, self._start[sub]}) - {branch.activating}
        return min((far[state] for state in states if state in far), default=inf)

    def _fall(self, sub: str) -> float:
        driven = self._own_way(sub, up=False).get(self._blueprint[sub].activating, inf)
        asked = [edge.cost for edge in self._crossings(sub, -1) if not self._closed(edge)]
        return min([*asked, driven])

    def _extras(self, branch: str, goal: str) -> list[tuple[int, Mapping[str, float]]]:
        """Return, for each sub-SB that stands still and is on at the goal, how much more its first
        rise costs from each of its states than the cheapest one.
        """
        found: list[tuple[int, Mapping[str, float]]] = []
        for digit, sub in self._hierarchy.subs[branch]:
            own = self._blueprint[sub]
            stands = sub in self._still and sub not in self._loaded
            if not stands or not self._blueprint[branch].is_on(goal, digit):
                continue
            far, least = self._own_way(sub, up=True), self._turn(sub, up=True)
            if least == inf:
                continue
            states = [state for state in own.states if state != own.activating]
            extra = {s: far[s] - least if s in far else inf for s in states}
            found.append((self._hierarchy.place[sub], extra))
        return found


def _spread(goal: str, edges: Iterable[tuple[Edge, float]]) -> dict[str, float]:
    """Return the least cost to a state from each state that has a way there (Dijkstra)."""
    into: dict[str, list[tuple[str, float]]] = {}
    for edge, cost in edges:
        into.setdefault(edge.target, []).append((edge.source, cost))
    far, heap = {goal: 0.0}, [(0.0, goal)]
    while heap:
        cost, state = heappop(heap)
        if cost > far[state]:
            continue
        for source, more in into.get(state, ()):
            further = round(cost + more, 9)
            if further < far.get(source, inf):
                far[source] = further
                heappush(heap, (further, source))
    return far
