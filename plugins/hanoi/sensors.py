"""What the camera and the fingers measure of each ring, and how that becomes its peg (paper, Eq.
5). A blueprint may decide otherwise from the same measures (``sources`` in ``_facts``).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from .disks import PEGS
from .table import HELD, LEVEL, NOWHERE, REACH, Table

if TYPE_CHECKING:
    from smsl_studio.library.operation_library import OperationLibrary

RESTS = (
    "disk_{n}_fingers < 2 and disk_{n}_from_%s - peg_play < 0 mm"
    " and disk_{n}_gap - stack_play < 0 mm and disk_{n}_tilt < 8.11 deg"
    " and disk_{n}_smaller_under < 1"
)
"""A ring is on a peg if it rests there on larger rings only. How exact that is depends on the size
of the rings."""


def register_sensors(library: OperationLibrary) -> None:
    """Register the sensors that measure, and the predicates of the facts."""

    @library.sensor("disk_{n}_fingers", unit="1")
    def fingers(table: Table, n: int) -> float | None:
        """How many fingers touch the ring."""
        return table.measured(n, lambda: table.world.fingers_on(table.disk(n).name))

    @library.sensor("disk_{n}_from_{peg}", unit="m")
    def from_peg(table: Table, n: int, peg: str) -> float | None:
        """The distance of its middle from the axis of a peg, seen from above."""
        if peg not in PEGS:
            return None
        return table.measured(n, lambda: table.distance(table.disk(n), peg))

    @library.sensor("disk_{n}_gap", unit="m")
    def gap(table: Table, n: int) -> float | None:
        """How far it, or a ring under it, is from where it would rest on the rings under it."""
        return table.measured(n, lambda: table.stack(table.disk(n)).gap)

    @library.sensor("disk_{n}_tilt", unit="deg")
    def tilt(table: Table, n: int) -> float | None:
        """How far it, or a ring under it, is turned away from lying flat."""
        return table.measured(n, lambda: table.stack(table.disk(n)).tilt)

    @library.sensor("disk_{n}_smaller_under", unit="1")
    def smaller_under(table: Table, n: int) -> float | None:
        """How many of it and the rings under it lie on a smaller ring."""
        return table.measured(n, lambda: table.stack(table.disk(n)).smaller)

    @library.sensor("peg_play", unit="m")
    def peg_play(table: Table) -> float:
        """How far the middle of a ring on a peg may be from the axis of the peg."""
        return REACH * table.size

    @library.sensor("stack_play", unit="m")
    def stack_play(table: Table) -> float:
        """How far a ring that rests may be from its height on the stack."""
        return LEVEL * table.size

    library.fact(
        "disk_{n}_peg",
        "{n}",
        {HELD: "disk_{n}_fingers >= 2", **{peg: RESTS % peg for peg in PEGS}},
        NOWHERE,
        words={HELD: "held", NOWHERE: "nowhere"},
    )
