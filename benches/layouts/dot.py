"""The picture that Graphviz ``dot`` makes of an SB, with nodes and labels as large as ours."""

from __future__ import annotations

import json
import shutil
import subprocess
from typing import Any

import numpy as np

from smsl_studio.picture.figure import Figure
from tests.picture.measured import NO_LABEL, Array, Drawing, Rect

PIXELS = 72.0
"""Pixels in an inch."""
PATIENCE = 240.0
"""Seconds after which a picture is given up."""


def is_here() -> bool:
    """Return whether Graphviz is installed."""
    return shutil.which("dot") is not None


def drawn_by_dot(figure: Figure, sizes: list[tuple[float, float]]) -> Drawing | None:
    """Return the drawing with a label of each size, or None if ``dot`` does not end in time."""
    picture = figure.picture
    lines = ['digraph { rankdir=LR; splines=true; node [shape=box fixedsize=true label=""]']
    for number, (_, _, w, h) in enumerate(figure.boxes.tolist()):
        lines.append(f"n{number} [width={2 * w / PIXELS:.4f} height={2 * h / PIXELS:.4f}]")
    edges = [edge for edge, target in enumerate(picture.target.tolist()) if target >= 0]
    for edge in edges:
        wide, high = sizes[edge]
        table = (
            f'<<TABLE BORDER="0" CELLBORDER="0" CELLSPACING="0" CELLPADDING="0" FIXEDSIZE="TRUE" '
            f'WIDTH="{wide:.0f}" HEIGHT="{high:.0f}"><TR><TD></TD></TR></TABLE>>'
        )
        between = f"n{picture.source[edge]} -> n{picture.target[edge]}"
        lines.append(f"{between} [id={edge} label={table}]")
    text = "\n".join([*lines, "}"])
    try:
        done = subprocess.run(
            ["dot", "-Tjson"],
            input=text,
            capture_output=True,
            text=True,
            timeout=PATIENCE,
            check=True,
        )
    except subprocess.TimeoutExpired:
        return None
    found = json.loads(done.stdout)
    nodes = [_box(one) for one in found["objects"]]
    by_id = {int(edge["id"]): edge for edge in found["edges"]}
    drawn = [by_id[edge] for edge in edges]
    labels: list[Rect | None] = [NO_LABEL] * len(drawn)
    for at, edge in enumerate(edges):
        labels[at] = _around(drawn[at]["lp"], *sizes[edge]) if "lp" in drawn[at] else None
    ends = [(int(picture.source[e]), int(picture.target[e])) for e in edges]
    return Drawing(nodes, ends, [_line(one["pos"]) for one in drawn], labels)


def _box(node: dict[str, Any]) -> Rect:
    return _around(node["pos"], float(node["width"]) * PIXELS, float(node["height"]) * PIXELS)


def _around(place: str, wide: float, high: float) -> Rect:
    x, y = map(float, place.split(","))
    return x - wide / 2, y - high / 2, x + wide / 2, y + high / 2


def _line(pos: str) -> Array:
    """Return the points of a line that is written as Bézier curves, with its arrowhead."""
    first: list[list[float]] = []
    last: list[list[float]] = []
    points: list[list[float]] = []
    for word in pos.split():
        kind, *numbers = word.split(",")
        if kind in ("e", "s"):
            (last if kind == "e" else first).append(list(map(float, numbers)))
        else:
            points.append([float(kind), float(numbers[0])])
    knots = np.array(points)
    t = np.linspace(0.0, 1.0, 17)[1:, None]
    pieces = [knots[:1]]
    for at in range(0, len(knots) - 3, 3):
        a, b, c, d = knots[at : at + 4]
        curve = (1 - t) ** 3 * a + 3 * (1 - t) ** 2 * t * b + 3 * (1 - t) * t**2 * c + t**3 * d
        pieces.append(curve)
    return np.vstack([np.array(one).reshape(-1, 2) for one in (first, *pieces, last)])
