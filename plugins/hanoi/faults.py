"""What can go wrong on the table, on purpose: each tampers with the world, none with the sensors.

They are generators: resumed once a tick, after the arm was told where to go and before the world
moves. Some wait for their moment (a ring in the hand) before they strike.
"""

from __future__ import annotations

from collections.abc import Generator
from typing import TYPE_CHECKING

from smsl_studio.errors import WorldError

from .disks import CAP, CAP_ASIDE, CAP_HEIGHT, CAP_LID, PEG_TOP, PEGS, Disk

if TYPE_CHECKING:
    from smsl_studio.library.operation_library import OperationLibrary

    from .table import Table

Fault = Generator[None, None, None]

RAISED = 0.03
"""How far (m) above the table a held ring's lower side is when it counts as lifted."""


def register_faults(library: OperationLibrary) -> None:
    """Offer the nine faults of the world ``hanoi``."""

    @library.fault("hanoi", "gripper_opens")
    def gripper_opens(table: Table, seconds: float = 1.0) -> Fault:
        """The fingers open as soon as a ring is lifted, and stay open for a while."""
        yield from _until_lifted(table)
        for _ in range(_ticks(table, seconds)):
            table.world.robot.open()
            yield

    @library.fault("hanoi", "slippery")
    def slippery(table: Table, disk: int = 0, friction: float = 0.005) -> None:
        """A ring (0: every ring) is greased."""
        for one in table.disks if disk == 0 else (table.disk(disk),):
            table.world.rub(one.name, friction)

    @library.fault("hanoi", "blocked_peg")
    def blocked_peg(table: Table, peg: str, seconds: float = 0.0) -> Fault:
        """A cap is put over a peg, for good or for a while: no ring goes on it."""
        _known(peg)
        stack = sum(disk.thickness for disk in table.on_peg(peg))
        rim = max(stack, PEG_TOP - CAP_HEIGHT + CAP_LID) + 0.0005
        table.world.place(CAP, (*PEGS[peg], rim + CAP_HEIGHT / 2))
        if seconds > 0.0:
            yield from _wait(_ticks(table, seconds))
            table.world.place(CAP, (*CAP_ASIDE, CAP_HEIGHT / 2))

    @library.fault("hanoi", "tower_carried")
    def tower_carried(table: Table) -> Fault:
        """The next ring that is gripped sticks to the one below it, until it is let go."""
        held = None
        while held is None or table.world.fingers_on(held.name) < 2:
            held = _gripped(table)
            yield
        below = _below(table, held)
        if below is None:
            return
        glue = table.world.stick(held.name, below.name)
        while table.world.fingers_on(held.name) == 2:
            yield
        table.world.unstick(glue)

    @library.fault("hanoi", "wrong_order")
    def wrong_order(table: Table) -> None:
        """A hand puts a ring on a smaller one: from another peg, or two of one tower swapped."""
        towers = [[d for d in table.on_peg(peg)] for peg in PEGS]
        tops = [tower[-1] for tower in towers if tower]
        for upper in sorted(tops, key=lambda disk: disk.number):
            for lower in tops:
                if lower.number < upper.number:
                    _put_on(table, upper, lower)
                    return
        for tower in towers:
            if len(tower) > 1:
                (x, y, z), _ = table.world.pose(tower[-1].name)
                below, _ = table.world.pose(tower[-2].name)
                table.world.place(tower[-1].name, below)
                table.world.place(tower[-2].name, (x, y, z))
                return
        raise WorldError("there are no two rings of which one could be put on the other")

    @library.fault("hanoi", "disk_pushed")
    def disk_pushed(table: Table, disk: int) -> None:
        """A ring lies beside its peg, flat on the table, towards the robot."""
        one = table.disk(disk)
        (_, y, _), _ = table.world.pose(one.name)
        table.world.place(one.name, (0.40, y, one.thickness / 2 + 0.001))

    @library.fault("hanoi", "seized_joint")
    def seized_joint(table: Table, joint: int = 1) -> None:
        """A joint of the arm (1 to 7, counted from the base) does not move any more."""
        if not 1 <= joint <= 7:
            raise WorldError(f"the arm has no joint {joint}", advice="Its joints are 1 to 7.")
        table.world.robot.seize(joint - 1)

    @library.fault("hanoi", "disk_off_board")
    def disk_off_board(table: Table, disk: int) -> None:
        """A ring is out of reach of the arm and out of sight of the camera."""
        one = table.disk(disk)
        table.world.place(one.name, (0.45, 0.8, one.thickness / 2 + 0.001))

    @library.fault("hanoi", "weak_grip")
    def weak_grip(table: Table, force: float = 0.1) -> None:
        """The fingers close with no more than this force (N)."""
        table.world.robot.weaken(force)


def _until_lifted(table: Table) -> Fault:
    while True:
        held = _gripped(table)
        if held is not None:
            (_, _, z), _ = table.world.pose(held.name)
            if z - held.thickness / 2 > RAISED:
                return
        yield


def _gripped(table: Table) -> Disk | None:
    return next((d for d in table.disks if table.world.fingers_on(d.name) == 2), None)


def _below(table: Table, disk: Disk) -> Disk | None:
    """The ring right under one, around the same peg."""
    (x, y, z), _ = table.world.pose(disk.name)
    under = []
    for other in table.disks:
        (ox, oy, oz), _ = table.world.pose(other.name)
        if other is not disk and abs(ox - x) < 0.015 and abs(oy - y) < 0.015 and oz < z:
            under.append((oz, other))
    return max(under, key=lambda found: found[0])[1] if under else None


def _put_on(table: Table, upper: Disk, lower: Disk) -> None:
    (x, y, z), _ = table.world.pose(lower.name)
    height = (lower.thickness + upper.thickness) / 2 + 0.0005
    table.world.place(upper.name, (x, y, z + height))


def _known(peg: str) -> None:
    if peg not in PEGS:
        raise WorldError(f"there is no peg {peg!r}", advice="There are the pegs a, b and c.")


def _ticks(table: Table, seconds: float) -> int:
    return max(1, round(seconds / table.world.tick))


def _wait(ticks: int) -> Fault:
    for _ in range(ticks):
        yield
