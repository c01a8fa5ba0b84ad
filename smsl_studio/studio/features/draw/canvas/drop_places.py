"""What lies at a point of the canvas where something is dropped: a state, or two around it."""

from __future__ import annotations

from itertools import permutations

import numpy as np
from PySide6.QtCore import QPointF

from smsl_studio.studio.base.canvas.sheet import Sheet

REACH = 26.0
"""How far from the line between two states a point still lies between them (scene units)."""
FAR = 520.0
"""So far apart two states may stand, to be dropped between (scene units)."""
NEAR = 8
"""So many states near the point are looked at."""


def state_below(sheet: Sheet, at: QPointF) -> str:
    """The state at a scene point; empty if there is none."""
    state = sheet.state_at(at.x(), at.y(), 3.0)
    return sheet.picture.names[state] if state >= 0 else ""


def states_around(sheet: Sheet, at: QPointF) -> tuple[str, str] | None:
    """The two states (from, to) between which a scene point lies; None if it lies nowhere so.

    On the line of an operation they are its ends. Elsewhere the nearer one is the first.
    """
    names = sheet.picture.names
    edge = sheet.edge_at(at.x(), at.y())
    if edge >= 0 and sheet.picture.target[edge] >= 0:
        return names[sheet.picture.source[edge]], names[sheet.picture.target[edge]]
    point = np.array((at.x(), at.y()))
    away = np.hypot(*(sheet.at - point).T)
    near = away.argsort()[:NEAR]
    found = [
        (off, (int(a), int(b)))
        for a, b in permutations(near.tolist(), 2)
        if away[a] <= away[b] and (off := _off(sheet.at[a], sheet.at[b], point)) is not None
    ]
    if not found:
        return None
    first, second = min(found)[1]
    return names[first], names[second]


def _off(a: np.ndarray, b: np.ndarray, point: np.ndarray) -> float | None:
    """How badly a point lies between two others; None if it does not."""
    step, to = b - a, point - a
    long = float(np.hypot(*step))
    if not 0.0 < long <= FAR:
        return None
    along = float(step @ to) / long
    aside = abs(float(step[0] * to[1] - step[1] * to[0])) / long
    if aside > REACH or not 0.0 < along < long:
        return None
    # Of two pairs in one row the nearer one is meant.
    return aside + long
