"""Obstacles: the nodes of a picture in a grid of cells, so that few of them are compared with a
line. Pure geometry.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from smsl_studio.picture.shape import Floats

Ints = NDArray[np.intp]
FEW = 100
"""So many nodes, or cells, are compared at once."""
_SAMPLES = 33
"""So many points of a piece that passes a corner are compared with it."""


class Obstacles:
    """The nodes that lines lead around. ``boxes`` is an (n, 4) array of centres and half sizes.

    Nodes that move are told with ``moved``, after their box has changed.
    """

    def __init__(self, boxes: Floats) -> None:
        self.boxes = boxes
        self._half = boxes[:, 2:].max() if len(boxes) else 1.0
        self._cell = max(float(self._half) * 2.0, 1e-3)
        self._rows: dict[tuple[int, int], list[int]] = {}
        if len(boxes) > FEW:
            cells = np.floor(boxes[:, :2] / self._cell).astype(np.int64).tolist()
            for row, (x, y) in enumerate(cells):
                self._rows.setdefault((x, y), []).append(row)

    def moved(self, row: int) -> None:
        """Note that a node stands elsewhere now. It may be found at its old place too."""
        if len(self.boxes) > FEW:
            x, y = np.floor(self.boxes[row, :2] / self._cell).astype(np.int64).tolist()
            self._rows.setdefault((x, y), []).append(row)

    def near(self, line: Floats, gap: float, skip: Sequence[int] = ()) -> Ints:
        """Return the nodes that are nearer than ``gap`` to the rectangle around a line, in order.

        ``skip`` has the nodes to leave out.
        """
        low, high = line.min(axis=0) - gap, line.max(axis=0) + gap
        rows = self._around(low, high)
        boxes = self.boxes if rows is None else self.boxes[rows]
        apart = np.abs(boxes[:, :2] - (low + high) / 2) - boxes[:, 2:] - (high - low) / 2
        inside = (apart < 0.0).all(axis=1)
        found = np.nonzero(inside)[0] if rows is None else rows[inside]
        for row in skip:
            found = found[found != row]
        return found

    def _around(self, low: Floats, high: Floats) -> Ints | None:
        """Return the nodes in the cells of a rectangle, None if that would be most of them."""
        if len(self.boxes) <= FEW:
            return None
        left, top = np.floor((low - self._half) / self._cell).astype(np.int64).tolist()
        right, bottom = np.floor((high + self._half) / self._cell).astype(np.int64).tolist()
        if (right - left + 1) * (bottom - top + 1) > FEW:
            return None
        found: set[int] = set()
        for x in range(left, right + 1):
            for y in range(top, bottom + 1):
                found.update(self._rows.get((x, y), ()))
        return np.array(sorted(found), dtype=np.intp)

    def met(self, line: Floats, gap: float, skip: Sequence[int] = ()) -> Ints:
        """Return the nodes that a line of points, (n, 2), meets, or passes nearer than ``gap`` in x
        and y.
        """
        rows = self.near(line, gap, skip)
        return (
            rows[pieces_hit(line[:-1], line[1:], self.boxes[rows], gap).any(axis=0)]
            if len(rows)
            else rows
        )

    def keep_clear(
        self, lines: Sequence[Floats], gap: float, skip: Sequence[int] = ()
    ) -> list[bool]:
        """Return for each of some lines, whether it is at least ``gap`` away from all nodes."""
        rows = self.near(np.vstack(lines), gap, skip)
        if not len(rows):
            return [True] * len(lines)
        boxes = self.boxes[rows]
        start = np.vstack([line[:-1] for line in lines])
        end = np.vstack([line[1:] for line in lines])
        owner = np.repeat(np.arange(len(lines)), [len(line) - 1 for line in lines])
        piece, box = np.nonzero(pieces_hit(start, end, boxes, gap))
        # Only beside the corners of a node is a line in the wider box and yet far enough away.
        shares = np.linspace(0.0, 1.0, _SAMPLES)[:, None, None]
        at = start[piece] + (end - start)[piece] * shares
        off = np.maximum(np.abs(at - boxes[box, :2]) - boxes[box, 2:], 0.0)
        near = (np.hypot(off[:, :, 0], off[:, :, 1]) < gap - 1e-6).any(axis=0)
        blocked = set(owner[piece[near]].tolist())
        return [at not in blocked for at in range(len(lines))]


def pieces_hit(start: Floats, end: Floats, boxes: Floats, gap: float) -> NDArray[np.bool_]:
    """Return for each straight piece, from ``start`` to ``end``, and each box whether they meet.

    A piece that only touches the border of a box does not meet it.
    """
    a, step = start[:, None, :], (end - start)[:, None, :]
    step = np.where(np.abs(step) < 1e-9, 1e-9, step)
    reach = boxes[:, 2:] + gap
    t1, t2 = (boxes[:, :2] - reach - a) / step, (boxes[:, :2] + reach - a) / step
    enter = np.minimum(t1, t2).max(axis=2)
    leave = np.maximum(t1, t2).min(axis=2)
    found: NDArray[np.bool_] = (enter < leave) & (leave > 0.0) & (enter < 1.0)
    return found
