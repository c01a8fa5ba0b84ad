"""Which names of a drawing a reader would take for those of another line; the order of lines.

The oracle knows nothing of how places are chosen. It lays points along all lines and measures.
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from smsl_studio.picture.geometry import Geometry
from smsl_studio.picture.hidden_names import hidden_names
from smsl_studio.picture.labels import AsideRect, leader

Array = np.ndarray[Any, np.dtype[np.float64]]
Rect = tuple[float, float, float, float]
STEP = 1.5
"""The distance of the points along a line (pixels of a mark)."""


class Astray(NamedTuple):
    """What is wrong in one drawing, as words with the name of the operation."""

    lines: list[str]
    """Labels that are as near to another line as to their own, or that cover another line."""
    labels: list[str]
    """Labels that cover a label, or the mark of names without room."""
    leaders: list[str]
    """Leaders that do not begin on their own line, or that cross another label."""
    marks: list[str]
    """Marks of names without room that lie on the line of another pair of states, or on a label."""


def astray(geometry: Geometry) -> Astray:
    """Measure all labels that a drawing shows."""
    picture, unit = geometry.picture, geometry.style.unit
    hidden = picture.bundles.hidden
    edges = [e for e in range(len(picture.operations)) if e not in hidden]
    geometry.prepare(edges)
    lines = {edge: _along(geometry.shape(edge).points, STEP * unit) for edge in edges}
    points = np.vstack([np.zeros((0, 2)), *lines.values()])
    owner = np.repeat(np.array(edges, dtype=int), [len(one) for one in lines.values()])
    shown = {e: rect for e in edges if (rect := geometry.label(e)) is not None}
    found = Astray([], [], [], [])
    for edge, rect in shown.items():
        name = picture.operations[edge]
        other = ~np.isin(owner, list(_family(geometry, edge)))
        away = _from_rect(points, rect)
        near = float(away[other].min(initial=np.inf))
        own = float(away[~other].min())
        if near <= (0.0 if isinstance(rect, AsideRect) else own):
            at = picture.operations[int(owner[other][away[other].argmin()])]
            found.lines.append(f"{name} at {at}: {near / unit:.1f} and {own / unit:.1f}")
        if isinstance(rect, AsideRect):
            found.leaders.extend(_leader_faults(geometry, edge, rect, shown))
        for second, over in shown.items():
            if second > edge and _meet(rect, over):
                found.labels.append(f"{name} and {picture.operations[second]}")
    for mark in hidden_names(geometry, edges):
        if not mark.radius:
            continue
        (x, y), own_pair = mark.at, _pair(geometry, mark.edges[0])
        half = (mark.radius - 1.0) * unit
        box = x - half, y - half, x + half, y + half
        name = f"{mark.words} of {picture.operations[mark.edges[0]]}"
        on = [picture.operations[e] for e, rect in shown.items() if _meet(box, rect)]
        found.marks.extend(f"{name} on the name {one}" for one in on)
        away = np.hypot(*(points - (x, y)).T)
        found.marks.extend(
            f"{name} on the line {picture.operations[e]}"
            for e in dict.fromkeys(owner[away < half].tolist())
            if _pair(geometry, e) != own_pair
        )
    return found


def orders(geometry: Geometry) -> dict[tuple[int, int], tuple[str, ...]]:
    """Return for each pair of states the operations between them, from one side to the other.

    Only lines count that run from one state to the other beside each other.
    """
    picture, found = geometry.picture, {}
    for a, b in picture.pairs():
        own = [*picture.between(a, b)[0], *picture.between(a, b)[1]]
        ways = {geometry.shape(edge).way for edge in own}
        if len(own) < 2 or not ways <= {"line", "curve"}:
            continue
        way = geometry.boxes[b, :2] - geometry.boxes[a, :2]
        across = np.array([-way[1], way[0]]) / np.hypot(*way)
        offs = {e: float(np.dot(geometry.shape(e).at(geometry.shape(e).length / 2), across))
                for e in own}  # fmt: skip
        found[a, b] = tuple(picture.operations[e] for e in sorted(own, key=offs.__getitem__))
    return found


def _family(geometry: Geometry, edge: int) -> Iterable[int]:
    """Return the lines with which a label may be taken for: its own. Arcs around one corner are
    one line for a reader.
    """
    picture = geometry.picture
    state = int(picture.source[edge])
    if picture.target[edge] != state or geometry.shape(edge).way != "loop":
        return [edge]
    return [e for e in picture.edges_of(state) if picture.target[e] == picture.source[e]]


def _pair(geometry: Geometry, edge: int) -> tuple[int, int]:
    a, b = int(geometry.picture.source[edge]), int(geometry.picture.target[edge])
    return min(a, b), max(a, b)


def _leader_faults(
    geometry: Geometry, edge: int, rect: AsideRect, shown: dict[int, Rect]
) -> list[str]:
    name = geometry.picture.operations[edge]
    foot, end = leader(geometry.shape(edge), rect)
    way = _along(np.array([foot, end]), 0.5 * geometry.style.unit)
    found = [] if geometry.shape(edge).distance(*foot) < 0.01 else [f"{name} hangs on nothing"]
    return found + [
        f"the leader of {name} crosses {geometry.picture.operations[other]}"
        for other, over in shown.items()
        if other != edge and float(_from_rect(way, over).min()) <= 0.0
    ]


def _along(points: Array, step: float) -> Array:
    """Return points along a line, at most ``step`` apart."""
    pieces = []
    for a, b in pairwise(points):
        count = max(int(np.hypot(*(b - a)) // step) + 1, 1)
        pieces.append(a + (b - a) * (np.arange(count) / count)[:, None])
    return np.vstack([*pieces, points[-1:]])


def _from_rect(points: Array, rect: Rect) -> Array:
    """Return how far each point is from a rectangle, 0 inside."""
    beside = np.maximum(np.maximum(rect[:2] - points, points - rect[2:]), 0.0)
    away: Array = np.hypot(beside[:, 0], beside[:, 1])
    return away


def _meet(a: Rect, b: Rect) -> bool:
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]
