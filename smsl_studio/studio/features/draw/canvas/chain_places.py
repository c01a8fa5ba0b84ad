"""Where a chain goes on that is drawn with Tab: in rows that fit into the view."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import QPointF

from smsl_studio.studio.base.canvas.branch_view import BranchView
from smsl_studio.studio.features.draw.canvas.free_places import AROUND, STEP

Position = tuple[float, float]
Table = Mapping[str, Mapping[str, str]]
LEAST = 4
"""The least number of states in a row of a chain."""
NEAR = 1.0
"""Two states stand in one row or column if they differ by less (scene units)."""


def chain_offsets(canvas: BranchView, table: Table, state: str) -> tuple[tuple[float, float], ...]:
    """The offsets from a state to the next one of its chain, best first.

    A row goes on while its next state is in view. If it is not, a row that is as long as the view
    at 100 % goes on in the row below, in the other direction.
    """
    places = canvas.positions
    if state not in places:
        return AROUND
    length, way, turned = _row(places, table, state)
    if turned:
        way = -_row(places, table, turned)[1]
    most = max(LEAST, int(canvas.viewport().width() / STEP[0]))
    x, y = places[state]
    if length >= most and not canvas.clear_view.contains(QPointF(x + way * STEP[0], y)):
        return (0.0, STEP[1]), *AROUND
    return (way * STEP[0], 0.0), *((way * dx, dy) for dx, dy in AROUND)


def _row(places: Mapping[str, Position], table: Table, state: str) -> tuple[int, float, str]:
    """How many states of the chain stand in the row of a state so far, and in which direction it
    goes on: 1.0 to the right, -1.0 to the left. If it has just turned down, the state above it
    follows, else an empty text."""
    length, way, here = 1, 0.0, state
    seen = {state}
    while True:
        before = next(
            (one for one, row in table.items() if one not in seen and here in row.values()), ""
        )
        if before not in places:
            return length, way or 1.0, ""
        seen.add(before)
        across = places[here][0] - places[before][0]
        down = places[here][1] - places[before][1]
        if abs(down) >= NEAR:
            # A row that begins below the end of another one leads the other way.
            return length, way or 1.0, before if abs(across) < NEAR and not way else ""
        step = 1.0 if across > 0 else -1.0
        if way and step != way:
            return length, way, ""
        length, way, here = length + 1, step, before
