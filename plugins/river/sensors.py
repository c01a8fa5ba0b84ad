"""What the camera and the fingers measure of each item, and how that becomes its place (paper, Eq.
5). A blueprint may decide otherwise from the same measures (``sources`` in ``_facts``).
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from .crossing import BANKS, DEPTH, HEIGHT, HELD, ITEMS, LEVEL, NOWHERE, SEATS, Crossing

if TYPE_CHECKING:
    from smsl_studio.library.operation_library import OperationLibrary

UPRIGHT = "11.48 deg"
"""The largest tilt of a standing item."""


def register_sensors(library: OperationLibrary) -> None:
    """Register the sensors that measure, and the predicates of the facts."""

    @library.sensor("item_{n}_fingers", unit="1")
    def fingers(crossing: Crossing, n: int) -> int:
        """How many fingers touch the item."""
        return crossing.world.fingers_on(ITEMS[n - 1])

    @library.sensor("item_{n}_tilt", unit="deg")
    def tilt(crossing: Crossing, n: int) -> float:
        """How far it is turned away from standing."""
        _, (qx, qy, _, _) = crossing.world.pose(ITEMS[n - 1])
        return math.degrees(math.acos(max(-1.0, min(1.0, 1.0 - 2.0 * (qx * qx + qy * qy)))))

    @library.sensor("item_{n}_x", unit="m")
    def x(crossing: Crossing, n: int) -> float:
        """How far its middle is in front of the arm."""
        return crossing.world.pose(ITEMS[n - 1])[0][0]

    @library.sensor("item_{n}_y", unit="m")
    def y(crossing: Crossing, n: int) -> float:
        """How far its middle is towards the green land, from the middle of the boat."""
        return crossing.world.pose(ITEMS[n - 1])[0][1]

    @library.sensor("item_{n}_foot", unit="m")
    def foot(crossing: Crossing, n: int) -> float:
        """The height of its lower side, if it stands."""
        return crossing.world.pose(ITEMS[n - 1])[0][2] - HEIGHT / 2

    places = {HELD: "item_{n}_fingers >= 2", **{value: _stands(value) for value in BANKS}}
    words = {HELD: "held", NOWHERE: "nowhere"}
    library.fact("item_{n}_place", "{n}", places, NOWHERE, words=words)


def _stands(value: str) -> str:
    """Return the condition under which an item stands on a bank or in the boat."""
    middle, ground = BANKS[value]
    low, high = SEATS[value][0] - 0.04, SEATS[value][-1] + 0.04
    ranges = (
        _between("item_{n}_x", low, high),
        _between("item_{n}_y", middle - DEPTH[value], middle + DEPTH[value]),
        _between("item_{n}_foot", ground - LEVEL, ground + LEVEL),
    )
    return f"item_{{n}}_fingers < 2 and item_{{n}}_tilt <= {UPRIGHT} and {' and '.join(ranges)}"


def _between(name: str, low: float, high: float) -> str:
    return f"{name} > {1000 * low:.1f} mm and {name} < {1000 * high:.1f} mm"
