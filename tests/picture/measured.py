"""Measures of a drawn picture: what a reader stumbles over, counted.

A drawing is given as plain boxes and lines, so pictures of other programs are measured in the same
way as ours.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from smsl_studio.picture.figure import Figure

Array = np.ndarray[Any, np.dtype[np.float64]]
Rect = tuple[float, float, float, float]
"""Left, top, right, bottom."""
TOUCH = 0.5
"""Boxes and lines that reach into each other by less than this (pixels) only touch."""
_AT_ONCE = 256


@dataclass(frozen=True)
class Drawing:
    """A picture: ``nodes`` and ``labels`` are rectangles, ``lines`` are rows of points.

    Line ``i`` joins the nodes ``ends[i]`` and has the label ``labels[i]``, None if it is hidden. A
    line without a name has the empty label ``NO_LABEL``.
    """

    nodes: Sequence[Rect]
    ends: Sequence[tuple[int, int]]
    lines: Sequence[Array]
    labels: Sequence[Rect | None]


NO_LABEL: Rect = (0.0, 0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Measures:
    """The figures of a drawing. Less is better in all of them.

    ``crossings`` counts the points where two lines cross. ``bends`` is how far all lines turn, in
    quarter turns. ``length`` is the length of all lines, ``area`` that of the whole picture, in
    pixels. ``label_on_label`` and ``label_on_node`` count the pairs that overlap. ``hidden`` is the
    number of labels that are not shown. ``edge_through_node`` counts the lines that pass through a
    node that is not their end, once for each node.
    """

    crossings: int
    bends: float
    length: float
    label_on_label: int
    label_on_node: int
    hidden: int
    edge_through_node: int
    area: float

    @property
    def overlaps(self) -> int:
        """What is wrong with labels: those that overlap something and those that are hidden."""
        return self.label_on_label + self.label_on_node + self.hidden

    def told(self) -> str:
        """Return all figures in one line."""
        names = (field.name for field in fields(self))
        return ", ".join(f"{n.replace('_', ' ')} {getattr(self, n):,.6g}" for n in names)


def measure(drawing: Drawing) -> Measures:
    """Return the measures of a drawing."""
    nodes = _rects(drawing.nodes)
    shown = [rect for rect in drawing.labels if rect is not None and rect[0] < rect[2]]
    labels = _rects(shown)
    pieces, owners = _pieces(drawing.lines)
    steps = pieces[:, 2:] - pieces[:, :2]
    corners = [pieces[:, :2], pieces[:, 2:], *(r.reshape(-1, 2) for r in (nodes, labels))]
    points = np.vstack(corners)
    wide, high = np.ptp(points, axis=0).tolist() if len(points) else (0.0, 0.0)
    return Measures(
        crossings=_crossings(pieces, owners),
        bends=round(sum(map(_turn, drawing.lines)), 1),
        length=round(float(np.hypot(steps[:, 0], steps[:, 1]).sum()), 1),
        label_on_label=_overlaps(labels, labels) // 2,
        label_on_node=_overlaps(labels, nodes),
        hidden=sum(rect is None for rect in drawing.labels),
        edge_through_node=_through(pieces, owners, nodes, drawing.ends),
        area=round(wide * high, 1),
    )


def drawing_of(figure: Figure) -> Drawing:
    """Return the picture that a file or the window shows of an SB, with a line for each operation.

    A label that the figure leaves out counts as hidden.
    """
    picture, geometry = figure.picture, figure.geometry
    edges = [edge for edge, target in enumerate(picture.target.tolist()) if target >= 0]
    boxes = figure.boxes
    nodes = np.hstack([boxes[:, :2] - boxes[:, 2:], boxes[:, :2] + boxes[:, 2:]])
    return Drawing(
        nodes=[(a, b, c, d) for a, b, c, d in nodes.tolist()],
        ends=[(int(picture.source[edge]), int(picture.target[edge])) for edge in edges],
        lines=[geometry.shape(edge).points for edge in edges],
        labels=[geometry.label(edge) for edge in edges],
    )


def _rects(rects: Sequence[Rect]) -> Array:
    return np.array(rects, dtype=np.float64).reshape(-1, 4)


def _pieces(lines: Sequence[Array]) -> tuple[Array, np.ndarray[Any, np.dtype[np.int64]]]:
    """Return the straight pieces of all lines, (n, 4), and the line of each. Points that lie in the
    middle of a straight piece are left out.
    """
    plain = [_plain(np.asarray(line, dtype=np.float64)) for line in lines]
    pieces = [np.hstack([line[:-1], line[1:]]) for line in plain]
    owners = np.repeat(np.arange(len(lines)), [len(piece) for piece in pieces])
    return np.vstack([np.zeros((0, 4)), *pieces]), owners


def _plain(line: Array) -> Array:
    step = np.diff(line, axis=0)
    line = line[np.concatenate([[True], (step != 0.0).any(axis=1)])]
    step = np.diff(line, axis=0)
    cross = step[:-1, 0] * step[1:, 1] - step[:-1, 1] * step[1:, 0]
    onwards = (step[:-1] * step[1:]).sum(axis=1) > 0.0
    straight = onwards & (np.abs(cross) < 1e-9)
    return np.asarray(line[np.concatenate([[True], ~straight, [True]])[: len(line)]])


def _turn(line: Array) -> float:
    """Return how far a line turns, in quarter turns."""
    step = np.diff(_plain(np.asarray(line, dtype=np.float64)), axis=0)
    angle = np.arctan2(step[:, 1], step[:, 0])
    turns = (np.diff(angle) + np.pi) % (2 * np.pi) - np.pi
    return float(np.abs(turns).sum() / (np.pi / 2))


def _crossings(pieces: Array, owners: np.ndarray[Any, np.dtype[np.int64]]) -> int:
    """Return the number of points in which pieces of different lines cross."""
    low = np.minimum(pieces[:, :2], pieces[:, 2:])
    high = np.maximum(pieces[:, :2], pieces[:, 2:])
    found = 0
    for first in range(0, len(pieces), _AT_ONCE):
        own = slice(first, first + _AT_ONCE)
        near = owners[own, None] < owners[None, :]
        for axis in (0, 1):
            near &= low[own, None, axis] <= high[None, :, axis]
            near &= low[None, :, axis] <= high[own, None, axis]
        a, b = near.nonzero()
        found += int(_cross(pieces[own][a], pieces[b]).sum())
    return found


def _cross(one: Array, other: Array) -> np.ndarray[Any, np.dtype[np.bool_]]:
    """Return for each pair of pieces whether they cross. The end of a piece is the begin of the
    next, so only its begin belongs to it.
    """
    d, e, gap = one[:, 2:] - one[:, :2], other[:, 2:] - other[:, :2], other[:, :2] - one[:, :2]
    area = d[:, 0] * e[:, 1] - d[:, 1] * e[:, 0]
    apart = np.abs(area) > 1e-9
    area = np.where(apart, area, 1.0)
    t = (gap[:, 0] * e[:, 1] - gap[:, 1] * e[:, 0]) / area
    u = (gap[:, 0] * d[:, 1] - gap[:, 1] * d[:, 0]) / area
    return np.asarray(apart & (t >= 0.0) & (t < 1.0) & (u >= 0.0) & (u < 1.0))


def _overlaps(some: Array, others: Array) -> int:
    """Return how many rectangles of one list overlap one of another. A rectangle does not overlap
    itself.
    """
    count = 0
    for first in range(0, len(some), _AT_ONCE):
        own = some[first : first + _AT_ONCE, None]
        deep = np.minimum(own[..., 2:], others[None, :, 2:])
        deep = deep - np.maximum(own[..., :2], others[None, :, :2])
        count += int((deep.min(axis=2) > TOUCH).sum())
    return count - (len(some) if some is others else 0)


def _through(
    pieces: Array,
    owners: np.ndarray[Any, np.dtype[np.int64]],
    nodes: Array,
    ends: Sequence[tuple[int, int]],
) -> int:
    found: set[tuple[int, int]] = set()
    step = pieces[:, 2:] - pieces[:, :2]
    step = np.where(np.abs(step) < 1e-9, 1e-9, step)
    for node, box in enumerate(nodes):
        one = (box[:2] + TOUCH - pieces[:, :2]) / step
        other = (box[2:] - TOUCH - pieces[:, :2]) / step
        enter = np.minimum(one, other).max(axis=1)
        leave = np.maximum(one, other).min(axis=1)
        hit = (enter < leave) & (leave > 0.0) & (enter < 1.0)
        found.update((line, node) for line in owners[hit].tolist() if node not in ends[line])
    return len(found)
