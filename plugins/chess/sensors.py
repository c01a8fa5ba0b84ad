"""What the camera and the fingers measure of each piece, and how that becomes its block (paper, Eq.
5). A blueprint may decide otherwise from the same measures (``sources`` in ``_facts``).

``piece_1_other_x`` is measured of the other piece than the first one, and so on.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

from .board import (
    BLOCKS,
    BOTTOM,
    GROUND,
    HEIGHT,
    HELD,
    LEVEL,
    NOWHERE,
    ON,
    PIECES,
    PITCH,
    TOP,
    Board,
)

if TYPE_CHECKING:
    from smsl_studio.library.operation_library import OperationLibrary

LOWEST, HIGHEST = 1000 * (GROUND - LEVEL), 1000 * (GROUND + LEVEL)
"""Between these heights (mm) is the lower side of a piece that stands on the board."""
STANDS = "{piece}_tilt < 11.48 deg"
LIES = (
    f"{{piece}}_foot > {LOWEST:.0f} mm and {{piece}}_foot < {HIGHEST:.0f} mm"
    " and {piece}_x > %.0f mm and {piece}_x < %.0f mm"
    " and {piece}_y > %.0f mm and {piece}_y < %.0f mm"
)
"""The lower side of a piece is on a block."""


def register_sensors(library: OperationLibrary) -> None:
    """Register the sensors that measure, and the predicates of the facts."""
    _place(library, "piece_{n}", lambda board, n: PIECES[n - 1])
    _place(library, "piece_{n}_other", lambda board, n: board.other(PIECES[n - 1]))

    @library.sensor("piece_{n}_fingers", unit="1")
    def fingers(board: Board, n: int) -> int:
        """How many fingers touch the piece."""
        return board.world.fingers_on(PIECES[n - 1])

    @library.sensor("piece_{n}_gap", unit="m")
    def gap(board: Board, n: int) -> float:
        """How far its height is from that of a piece on top of the other one."""
        piece = PIECES[n - 1]
        return abs(board.middle(piece)[2] - board.middle(board.other(piece))[2] - HEIGHT)

    @library.sensor("piece_{n}_off", unit="m")
    def off(board: Board, n: int) -> float:
        """How far it is beside the middle of the other piece, seen from above."""
        (x, y, _), piece = board.middle(PIECES[n - 1]), PIECES[n - 1]
        ox, oy, _ = board.middle(board.other(piece))
        return math.hypot(x - ox, y - oy)

    words = {HELD: "held", NOWHERE: "nowhere"}
    library.fact("piece_{n}_block", "{n}", _conditions(), NOWHERE, words=words)


def _place(library: OperationLibrary, name: str, piece: Callable[[Board, int], str]) -> None:
    """Register the sensors of where a piece is."""

    @library.sensor(f"{name}_tilt", unit="deg")
    def tilt(board: Board, n: int) -> float:
        """How far it is turned away from standing."""
        _, (qx, qy, _, _) = board.world.pose(piece(board, n))
        return math.degrees(math.acos(max(-1.0, min(1.0, 1.0 - 2.0 * (qx * qx + qy * qy)))))

    @library.sensor(f"{name}_x", unit="m")
    def x(board: Board, n: int) -> float:
        """How far its middle is in front of the arm."""
        return board.middle(piece(board, n))[0]

    @library.sensor(f"{name}_y", unit="m")
    def y(board: Board, n: int) -> float:
        """How far its middle is beside the middle line of the arm."""
        return board.middle(piece(board, n))[1]

    @library.sensor(f"{name}_foot", unit="m")
    def foot(board: Board, n: int) -> float:
        """The height of its lower side, if it stands."""
        return board.middle(piece(board, n))[2] - HEIGHT / 2


def _conditions() -> dict[str, str]:
    """Return the conditions of all places of a piece: on each block, and there on the other one."""
    free = f"piece_{{n}}_fingers < 2 and {STANDS.replace('{piece}', 'piece_{n}')}"
    near = f"piece_{{n}}_gap < {1000 * LEVEL:.0f} mm and piece_{{n}}_off < {1000 * ON:.0f} mm"
    above = f"{STANDS.replace('{piece}', 'piece_{n}_other')} and {near}"
    found = {HELD: "piece_{n}_fingers >= 2"}
    for block, (x, y) in BLOCKS.items():
        half = PITCH / 2
        edges = tuple(1000 * edge for edge in (x - half, x + half, y - half, y + half))
        lies = LIES % edges
        found[block + BOTTOM] = f"{free} and {lies.replace('{piece}', 'piece_{n}')}"
        found[block + TOP] = f"{free} and {above} and {lies.replace('{piece}', 'piece_{n}_other')}"
    return found
