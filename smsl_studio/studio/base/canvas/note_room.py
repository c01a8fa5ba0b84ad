"""Finds room for notes after a layout: none covers a state, a label, a title or another note."""

from __future__ import annotations

import numpy as np

from smsl_studio.picture.shape import Floats
from smsl_studio.studio.base.canvas.sheet import Position, Sheet

STEP, RINGS = 24.0, 24
"""The distance between the places that are tried around a note, and how many to each side."""
GAP = 4.0
"""The smallest distance between a note and anything else (scene units)."""
MOST_NOTES = 300
"""If there are more notes, none is moved."""
ZOOMS = (1.0, 0.5)
"""The zooms at which a note must cover no label. Labels of compact states stand elsewhere."""


def notes_in_room(sheet: Sheet) -> dict[str, Position]:
    """The places (``at``) of the notes that have to move, by key. The nearest room is taken.

    A note that finds no room nearby stays where it is.
    """
    parts = sheet.drawn.parts
    if len(parts.notes) > MOST_NOTES:
        return {}
    rects = parts.note_rects(sheet.at)
    taken = np.vstack([_around(sheet, zoom, rects) for zoom in ZOOMS])
    ways = _ways()
    moved: dict[str, Position] = {}
    for number, key in enumerate(parts.note_keys):
        rect = rects[number]
        tried = np.hstack([rect[:2] + ways, rect[2:] + ways])
        low, high = taken[:, :2] - GAP, taken[:, 2:] + GAP
        near = ((low < tried[:, 2:].max(axis=0)) & (high > tried[:, :2].min(axis=0))).all(axis=1)
        meets = (tried[:, None, :2] < high[near]) & (tried[:, None, 2:] > low[near])
        free = np.flatnonzero(~meets.all(axis=2).any(axis=1))
        if len(free) and free[0]:
            rect = tried[free[0]]
            state = int(parts.states[number])
            x, y = rect[:2] - (sheet.at[state] if state >= 0 else 0.0)
            moved[key] = float(x), float(y)
        taken = np.vstack([taken, rect])
    return moved


def _ways() -> Floats:
    """The ways from a note to the places that are tried, nearest first, (n, 2)."""
    steps = np.arange(-RINGS, RINGS + 1) * STEP
    ways = np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)
    order = np.argsort((ways**2).sum(axis=1), kind="stable")
    found: Floats = ways[order]
    return found


def _around(sheet: Sheet, zoom: float, notes: Floats) -> Floats:
    """The rectangles of nodes, labels and titles of groups near notes at a zoom, (n, 4)."""
    sheet.set_zoom(zoom)
    reach, half, drawn = STEP * RINGS, sheet.halves(), sheet.drawn
    left, top = notes[:, :2].min(axis=0) - reach
    right, bottom = notes[:, 2:].max(axis=0) + reach
    states = sheet.states_in(left, top, right, bottom)
    nodes = np.hstack([sheet.at[states] - half[states], sheet.at[states] + half[states]])
    titles = drawn.group_rects.copy()
    titles[:, 3] = titles[:, 1] + drawn.bar * sheet.unit
    edges = sheet.edges_in(left, top, right, bottom).tolist()
    labels = [rect for edge in edges if (rect := sheet.geometry.label(edge)) is not None]
    return np.vstack([nodes, titles, np.array(labels, dtype=np.float64).reshape(-1, 4)])
