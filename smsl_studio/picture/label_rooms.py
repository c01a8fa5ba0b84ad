"""The rooms around labels, in which a change can move them. Pure geometry."""

from __future__ import annotations

from collections.abc import Container, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from smsl_studio.picture.label_candidates import FARTHEST
from smsl_studio.picture.labels import Rect
from smsl_studio.picture.shape import Floats


class LabelRooms:
    """The rooms around some labels, in which a change can move them, all looked at together."""

    def __init__(
        self,
        lines: Mapping[int, Rect],
        sizes: Mapping[int, tuple[float, float]],
        on_line: Container[int],
        unit: float,
    ) -> None:
        """``lines`` has the bounds of the lines. The labels ``on_line`` have found a place there.
        What is farther away did not matter. The others stand at most ``FARTHEST`` beside them.
        """
        self._edges = np.array(list(lines), dtype=np.intp)
        size = np.array([sizes[edge] for edge in lines]).reshape(-1, 2)
        near = np.array([edge in on_line for edge in lines], dtype=bool)[:, None]
        # The middle of a label beside a slanted line can be so far from it.
        pad = size + np.where(near, size[:, ::-1] / 4 + 3.0 * unit, FARTHEST * unit)
        bounds = np.array(list(lines.values())).reshape(-1, 4)
        self._rooms = np.hstack([bounds[:, :2] - pad, bounds[:, 2:] + pad])
        self._seen = 0
        self._quiet = frozenset(lines)

    def quiet(self, far: Sequence[Rect]) -> frozenset[int]:
        """Return the edges in whose rooms no change has been so far.

        ``far`` has the places of the changes. It may only grow from one question to the next.
        """
        if self._seen < len(far):
            loud = meeting(self._rooms, far[self._seen :])
            self._quiet = self._quiet.difference(self._edges[loud].tolist())
            self._seen = len(far)
        return self._quiet


def meeting(rects: Floats | Sequence[Rect], others: Sequence[Rect]) -> NDArray[np.bool_]:
    """Return for each rectangle, (n, 4), whether it overlaps one of the others."""
    one = np.asarray(rects, dtype=np.float64).reshape(-1, 1, 4)
    two = np.array(others, dtype=np.float64).reshape(1, -1, 4)
    over = np.concatenate([two[..., 2:] - one[..., :2], one[..., 2:] - two[..., :2]], axis=2)
    found: NDArray[np.bool_] = np.all(over > 0.0, axis=2).any(axis=1)
    return found
