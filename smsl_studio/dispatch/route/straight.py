"""The best route by a decomposition: at each configuration only its own moves are looked at."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from math import inf

from smsl_studio.blueprint.search import Move, PlanSearch
from smsl_studio.dispatch.route.decomposition import Decomposition, Key
from smsl_studio.dispatch.route.ranks import Rank, cost_of, rank_of

Moves = Callable[[Key], Iterator[Move]]


class StraightSearch:
    """It goes straight to the goal: the next move is the first by name among those after which the
    rest costs exactly what is left. ``PlanSearch`` finds the same moves.

    ``moves`` yields the moves out of a configuration. ``walk`` makes a search over configurations.
    It is used only if the costs are so high that floats compare them otherwise than exact numbers.
    """

    def __init__(
        self, start: Key, ranks: Decomposition, moves: Moves, walk: Callable[[], PlanSearch[Key]]
    ) -> None:
        self._node, self._ranks, self._moves, self._walk = start, ranks, moves, walk
        self._route: list[Move] = []
        self._left: Rank | None = None
        self._search: PlanSearch[Key] | None = None

    def found(self) -> list[Move] | None:
        """Return the moves, None if no path leads to a goal. PlanningError as that of the walk.

        It heeds the listener (see ``stop``). If it is called off and asked again, it goes on.
        """
        if self._left is None:
            left = self._ranks.rank(self._node)
            if left < inf and cost_of(left) > self._ranks.most:
                self._search = self._walk()
            self._left = left
        if self._search is not None:
            return self._search.found()
        if self._left == inf:
            return None
        while self._left:
            if not self._step():
                self._search = self._walk()
                return self._search.found()
        return self._route

    def _step(self) -> bool:
        """Take the next move. Return whether there is one."""
        assert self._left is not None
        ways: list[tuple[Move, Rank]] = []
        for move in self._moves(self._node):
            own = rank_of(move.cost, move.number, 1)
            if own <= self._left and own + self._ranks.rank(move.to) == self._left:
                ways.append((move, self._left - own))
        if not ways:
            return False
        move, left = ways[0]
        if len(ways) > 1:
            move, left = min(ways, key=lambda way: (way[0].names(), way[0].key))
        self._route.append(move)
        self._node, self._left = move.to, left
        return True
