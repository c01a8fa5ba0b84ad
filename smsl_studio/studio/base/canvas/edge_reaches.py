"""The reaches of edges: a rectangle around each line, found without a routing."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from smsl_studio.blueprint.edge_layout import EdgeLayout
from smsl_studio.picture.picture import Picture
from smsl_studio.picture.shape import Floats

Numbers = NDArray[np.intp]


class EdgeReaches:
    """The rectangles around the straight lines of all edges, with bends and moved labels.

    ``version`` is the number of the last layout for which they were computed.
    """

    def __init__(self, picture: Picture) -> None:
        self.version = -1
        self._source = picture.source
        self._target = np.where(picture.target < 0, picture.source, picture.target)
        self._low = self._high = np.zeros((2, 0))

    def compute(self, version: int, at: Floats, lines: Mapping[int, EdgeLayout]) -> None:
        """Compute the rectangles. ``at`` has the places of the states (scene units, (n, 2)).

        ``lines`` are the edges whose line or label is drawn by hand.
        """
        a, b = at[self._source].T, at[self._target].T
        self.version, self._low, self._high = version, np.minimum(a, b), np.maximum(a, b)
        for edge, layout in lines.items():
            self._widen(edge, layout)

    def touching(self, sides: tuple[float, float, float, float], room: float) -> Numbers:
        """Return the edges whose rectangle is at most ``room`` away from a rectangle, in x and y.

        ``sides`` are its left, top, right and bottom (scene units).
        """
        left, top, right, bottom = sides
        inside = (
            (self._high[0] >= left - room)
            & (self._low[0] <= right + room)
            & (self._high[1] >= top - room)
            & (self._low[1] <= bottom + room)
        )
        return np.nonzero(inside)[0]

    def _widen(self, edge: int, layout: EdgeLayout) -> None:
        """Let the rectangle of an edge hold its bends, and its label if that was moved."""
        low, high = self._low, self._high
        for x, y in layout.bends:
            low[:, edge] = np.minimum(low[:, edge], (x, y))
            high[:, edge] = np.maximum(high[:, edge], (x, y))
        if layout.label is not None:
            aside = max(map(abs, layout.label[1:]))
            low[:, edge] -= aside
            high[:, edge] += aside
