"""A lower bound of the cost that is left, so that a search does not walk where nothing leads on.

Each SB with a goal is looked at alone, in its own graph. An edge that turns the digit of a sub-SB
costs at least what the cheapest crossing of this sub-SB costs.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from heapq import heappop, heappush
from math import inf

from .elements import Configuration, Edge
from .goals import Goal
from .search import Node
from .stepper import Stepper


class Estimate:
    """The lower bound from each joint configuration to one in which all ``wanted`` hold."""

    def __init__(
        self,
        stepper: Stepper,
        start: Configuration,
        wanted: Sequence[Goal],
        movers: Collection[str],
    ) -> None:
        self._stepper, self._hierarchy = stepper, stepper.hierarchy
        self._loaded = {
            sub
            for name in movers
            if any(terms.load for terms in stepper.blueprint[name].operations.values())
            for sub in stepper.hierarchy.tree(name)[1:]
        }
        self._turns: dict[tuple[str, bool], float] = {}
        self._parts = [
            (self._hierarchy.place[branch], self._far(branch, state))
            for branch, state in wanted
            if branch in movers and branch not in self._loaded
        ]

    def __call__(self, node: Node) -> float:
        """Return a lower bound of the cost that is left, ``inf`` if there is no way."""
        return max((far.get(node[at], inf) for at, far in self._parts), default=0.0)

    def _far(self, branch: str, goal: str) -> dict[str, float]:
        """Return the bound of the SB's own way to a state, from every state that has one."""
        into: dict[str, list[Edge]] = {}
        for state in self._stepper.blueprint[branch].states:
            for edge in self._stepper.edges.out(branch, state):
                into.setdefault(edge.target, []).append(edge)
        far, heap = {goal: 0.0}, [(0.0, goal)]
        while heap:
            cost, state = heappop(heap)
            if cost > far[state]:
                continue
            for edge in into.get(state, ()):
                further = round(cost + self._least(edge), 9)
                if further < far.get(edge.source, inf):
                    far[edge.source] = further
                    heappush(heap, (further, edge.source))
        return far

    def _least(self, edge: Edge) -> float:
        """Return what a joint step with this edge costs at least, ``inf`` if it is closed."""
        if next(self._stepper.terms.closures(edge), None) is not None:
            return inf
        subs = dict(self._hierarchy.subs[edge.branch])
        turned = {(subs[digit], True) for digit in edge.rises}
        turned |= {(subs[digit], False) for digit in edge.falls}
        return edge.cost + sum(self._turn(sub, up) for sub, up in turned)

    def _turn(self, sub: str, up: bool) -> float:
        """Return the least cost of an operation by which a sub-SB enters or leaves ACTIVATING."""
        if sub in self._loaded:
            return 0.0
        if (sub, up) not in self._turns:
            crossing = 1 if up else -1
            self._turns[sub, up] = min(
                (
                    self._least(edge)
                    for state in self._stepper.blueprint[sub].states
                    for edge in self._stepper.edges.out(sub, state)
                    if edge.crossing == crossing
                ),
                default=inf,
            )
        return self._turns[sub, up]
