"""The best route by a decomposition: at each configuration only its own moves are looked at."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from math import inf

from smsl_studio.blueprint.search import Move, PlanSearch
from smsl_studio.dispatch.route.decomposition import Decomposition, Key
from smsl_studio.dispatch.route.ranks import Rank, cost_of, rank_of

MOST_LOST = 200
"""The number of configurations without a way on after which the walk is quicker."""

Moves = Callable[[Key], Iterator[Move]]


class StraightSearch:
    """It goes straight to the goal: the next move is the first by name among those after which the
    rest costs exactly what is left. ``PlanSearch`` finds the same moves.

    If the ranks are only bounds, such a move may lead where no other fits. Then the next one is
    tried. A route that is found costs as much as the bound, so none is better, and those before it
    by name do not exist. ``moves`` yields the moves out of a configuration. ``walk`` makes a search
    over configurations. It is used if no route is as cheap as the bound, or if the costs are so
    high that floats compare them otherwise than exact numbers.
    """

    def __init__(
        self, start: Key, ranks: Decomposition, moves: Moves, walk: Callable[[], PlanSearch[Key]]
    ) -> None:
        self._start, self._ranks, self._moves, self._walk = start, ranks, moves, walk
        self._left: Rank | None = None
        self._route: list[Move] = []
        self._ways: list[list[Move]] = []
        """For each move of the route those that are tried after it, the next one last."""
        self._lost: set[Key] = set()
        self._search: PlanSearch[Key] | None = None

    def found(self) -> list[Move] | None:
        """Return the moves, None if no path leads to a goal. PlanningError as that of the walk.

        It heeds the listener (see ``stop``). If it is called off and asked again, it goes on.
        """
        if self._left is None:
            left = self._ranks.rank(self._start)
            if left < inf and cost_of(left) > self._ranks.most:
                self._search = self._walk()
            self._left = left
        if self._left == inf:
            return None
        while self._search is None:
            if not self._left:
                return self._route
            if not self._step():
                self._search = self._walk()
        return self._search.found()

    def _step(self) -> bool:
        """Take the next move, or take moves back. Return whether the search goes on."""
        assert self._left is not None
        node = self._route[-1].to if self._route else self._start
        ways = list(self._fitting(node, self._left))
        if len(ways) > 1:
            ways.sort(key=lambda move: (move.names(), move.key), reverse=True)
        self._ways.append(ways)
        while self._ways and not self._ways[-1]:
            self._ways.pop()
            self._lost.add(self._route[-1].to if self._route else self._start)
            if self._route:
                self._left += _rank(self._route.pop())
        if not self._ways or len(self._lost) > MOST_LOST:
            return False
        move = self._ways[-1].pop()
        self._route.append(move)
        self._left -= _rank(move)
        return True

    def _fitting(self, node: Key, left: Rank) -> Iterator[Move]:
        """Yield the moves after which the rest costs what is left."""
        for move in self._moves(node):
            own = _rank(move)
            if own > left or move.to in self._lost:
                continue
            if own + self._ranks.rank(move.to) == left:
                yield move


def _rank(move: Move) -> int:
    return rank_of(move.cost, move.number, 1)
