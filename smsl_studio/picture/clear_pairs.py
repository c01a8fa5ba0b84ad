"""The pairs of states whose lines have no other node in their way."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from smsl_studio.picture.curves import Between, LineStyle, breadth
from smsl_studio.picture.detours import GAP
from smsl_studio.picture.former import FormerLines
from smsl_studio.picture.obstacles import Obstacles
from smsl_studio.picture.shape import NodeBox


class ClearPairs:
    """Tells for a pair of states whether all lines between them miss all other nodes.

    Such lines need no detour. ``known`` has the answers so far, by the numbers of both states.
    """

    def __init__(
        self, obstacles: Obstacles, style: LineStyle, box: Callable[[int], NodeBox]
    ) -> None:
        self.known: dict[tuple[int, int], bool] = {}
        self._obstacles, self._style, self._box = obstacles, style, box

    def holds(self, pair: Between, former: FormerLines | None) -> bool:
        """Return whether the lines of a pair miss all other nodes.

        ``former`` is the routing before an edit. Its answer is taken if nothing has changed there.
        """
        found = self.known.get((pair.a, pair.b))
        if found is None:
            if former is not None:
                found = former.clear(pair, self._box(pair.a), self._box(pair.b))
            if found is None:
                self.look([pair])
                return self.known[pair.a, pair.b]
            self.known[pair.a, pair.b] = found
        return found

    def look(self, pairs: Sequence[Between]) -> None:
        """Find the answers for many pairs at once, which is faster than one by one."""
        if not pairs:
            return
        gaps = [
            GAP * self._style.unit + breadth(p, self._box(p.a), self._box(p.b), self._style)
            for p in pairs
        ]
        ends = np.array([(p.a, p.b) for p in pairs])
        stopped = self._obstacles.stop_each(ends, np.array(gaps)).tolist()
        for pair, stop in zip(pairs, stopped, strict=True):
            self.known[pair.a, pair.b] = not stop
