"""Obstacles: the nodes of a picture that a line may meet. Pure geometry."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from smsl_studio.picture.shape import Floats

Ints = NDArray[np.intp]
_AT_ONCE = 500
"""The number of lines that are compared with all nodes at once. It limits the memory."""
_SAMPLES = 33
"""The number of points of a piece whose distances from the corner of a node are computed."""


class Obstacles:
    """The nodes that lines lead around. ``boxes`` is an (n, 4) array of centres and half sizes."""

    def __init__(self, boxes: Floats) -> None:
        self.boxes = boxes

    def near(self, line: Floats, gap: float, skip: Sequence[int] = ()) -> Ints:
        """Return the nodes that are nearer than ``gap`` to the bounds of a line, in order.

        ``skip`` has the nodes that do not count.
        """
        low, high = line.min(axis=0) - gap, line.max(axis=0) + gap
        boxes = self.boxes
        apart = np.abs(boxes[:, :2] - (low + high) / 2) - boxes[:, 2:] - (high - low) / 2
        found = np.nonzero((apart < 0.0).all(axis=1))[0]
        for row in skip:
            found = found[found != row]
        return found

    def stop_each(self, ends: Ints, gaps: Floats) -> NDArray[np.bool_]:
        """Return for each pair of nodes, (n, 2), whether another node is in the way.

        That is a node that is nearer than the gap of the pair, (n,), to the straight line between
        the two centres.
        """
        found = np.zeros(len(ends), dtype=bool)
        for first in range(0, len(ends), _AT_ONCE):
            some = slice(first, first + _AT_ONCE)
            pair = ends[some]
            hit = pieces_hit(
                self.boxes[pair[:, 0], :2], self.boxes[pair[:, 1], :2], self.boxes, gaps[some]
            )
            every = np.arange(len(pair))
            hit[every, pair[:, 0]] = hit[every, pair[:, 1]] = False
            found[some] = hit.any(axis=1)
        return found

    def met(self, line: Floats, gap: float, skip: Sequence[int] = ()) -> Ints:
        """Return the nodes that a line of points, (n, 2), meets. Nodes are wider by ``gap`` on each
        side.
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
        """Return for each line whether it keeps a distance of ``gap`` or more from all nodes."""
        rows = self.near(np.concatenate(lines), gap, skip)
        if not len(rows):
            return [True] * len(lines)
        boxes = self.boxes[rows]
        start = np.concatenate([line[:-1] for line in lines])
        end = np.concatenate([line[1:] for line in lines])
        owner = np.repeat(np.arange(len(lines)), [len(line) - 1 for line in lines])
        piece, box = np.nonzero(pieces_hit(start, end, boxes, gap))
        # The wider box has sharp corners, so a line in it can still be far enough from the node.
        shares = np.linspace(0.0, 1.0, _SAMPLES)[:, None, None]
        at = start[piece] + (end - start)[piece] * shares
        off = np.maximum(np.abs(at - boxes[box, :2]) - boxes[box, 2:], 0.0)
        near = (np.hypot(off[:, :, 0], off[:, :, 1]) < gap - 1e-6).any(axis=0)
        blocked = set(owner[piece[near]].tolist())
        return [at not in blocked for at in range(len(lines))]


def pieces_hit(start: Floats, end: Floats, boxes: Floats, gap: float | Floats) -> NDArray[np.bool_]:
    """Return for each straight piece, from ``start`` to ``end``, whether it meets each box, (n, m).

    Boxes are wider by ``gap`` on each side. ``gap`` is one number, or one for each piece, (n,). A
    piece that only touches the border of a box does not meet it.
    """
    a, step = start[:, None, :], (end - start)[:, None, :]
    step = np.where(np.abs(step) < 1e-9, 1e-9, step)
    reach = boxes[:, 2:] + np.asarray(gap).reshape(-1, 1, 1)
    t1, t2 = (boxes[:, :2] - reach - a) / step, (boxes[:, :2] + reach - a) / step
    enter = np.minimum(t1, t2).max(axis=2)
    leave = np.maximum(t1, t2).min(axis=2)
    found: NDArray[np.bool_] = (enter < leave) & (leave > 0.0) & (enter < 1.0)
    return found
