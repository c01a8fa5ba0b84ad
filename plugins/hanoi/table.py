"""The table: the start places of the rings, and the readings of the sensors."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from smsl_studio.errors import WorldError
from smsl_studio.world.arms.panda import ARM
from smsl_studio.world.bodies import Body, Floor, Robot
from smsl_studio.world.protocol import Vector
from smsl_studio.world.reach import refuse_unreached
from smsl_studio.world.stations import Station

from .disks import CLEAR, MIDDLE, PEGS, TIPS, Disk, cap_body, disks_for, peg_body, pegs_for

if TYPE_CHECKING:
    from smsl_studio.world.bullet import BulletWorld

JITTER = 0.003
"""The largest distance (m) of a ring's start from the middle of its peg, along x and along y."""

HELD, NOWHERE = "h", "x"
REACH = 0.0085
"""The largest distance (m) between the middles of a ring and its peg for a ring on the peg, for a
robot of the size 1."""

LEVEL = 0.004
"""The largest distance (m) of a resting ring from its height on the stack, for a robot of the
size 1."""

TILT = 0.99
"""The smallest vertical part of a resting ring's axis: the cosine of 8 degrees."""

SIGHT = ((0.0, 1.0), (-0.6, 0.6), (-0.05, 1.0))
"""The part of the room (m) that the camera sees."""


@dataclass(frozen=True)
class Stack:
    """How a ring and those under it on its peg lie: the largest distance (m) of one from where it
    would rest, the largest tilt (deg), and how many lie on a ``smaller`` one.
    """

    gap: float
    tilt: float
    smaller: int

    def with_one(self, other: Stack, on_smaller: bool) -> Stack:
        """Return the stack with one more ring on top."""
        return Stack(
            max(self.gap, other.gap), max(self.tilt, other.tilt), self.smaller + on_smaller
        )


def stations_of(robot: Robot) -> dict[str, tuple[Station, ...]]:
    """Return the lowest and the highest place of the tool at the peg to which an operation brings a
    ring, for the operations of each peg."""
    size = robot.size
    found: dict[str, tuple[Station, ...]] = {}
    for peg, (x, y) in pegs_for(size).items():
        found[f"Op_{{disk}}{peg}"] = (
            Station(f"the foot of peg {peg}", (x, y, TIPS * size)),
            Station(f"the top of peg {peg}", (x, y, (CLEAR + TIPS) * size)),
        )
    return found


class Table:
    """A robot, three pegs and the rings of one game in a physical world.

    Rings, pegs and the ways between them have the ``size`` that the robot's hand is made for.
    ``pegs`` has the place (m) of each peg.
    """

    def __init__(self, world: BulletWorld, count: int, seed: int, robot: Robot = ARM) -> None:
        self.world, self.robot = world, robot
        self.size = robot.size
        self.disks = disks_for(count, self.size)
        self.pegs = pegs_for(self.size)
        self.seed = seed
        self._readings: dict[int, str] = {}
        self._read_at = -1
        self._stacks: dict[int, Stack] = {}
        self._stacked_at = -1

    def furnish(self) -> None:
        """Put all bodies into the empty world, with all rings on peg a."""
        self.world.add(Body("table", Floor(), (0.0, 0.0, 0.0), friction=0.5))
        for name in PEGS:
            self.world.add(peg_body(name, self.size))
        for disk, place in self._places(dict.fromkeys(self.disks, "a")):
            self.world.add(disk.body(place))
        self.world.add(cap_body(self.size))
        self.world.add(self.robot)
        every = (place for own in stations_of(self.robot).values() for place in own)
        refuse_unreached(self.world, self.robot.name, every)
        self.world.settle()

    def arrange(self, pegs: Mapping[Disk, str]) -> None:
        """Begin again with each ring at rest on its peg, smaller rings above larger rings.

        A ring on no peg lies flat beside the pegs, towards the robot.

        Equal pegs and an equal seed give an equal table. Earlier events do not matter.
        """
        self.world.rebuild()
        for disk, place in self._places(pegs):
            self.world.place(disk.name, place)
        self.world.settle()

    def disk(self, number: int) -> Disk:
        """Return a ring by its number, 1 for the smallest. WorldError if the game has no such
        ring."""
        if not 1 <= number <= len(self.disks):
            raise WorldError(f"there is no disk {number}: this table has {len(self.disks)}")
        return self.disks[number - 1]

    def reading(self, disk: Disk) -> str | None:
        """Return the camera's reading of a ring: its peg, ``h`` for held, or ``x`` for any other
        place.

        The reading is a peg only if the ring rests there with only larger rings under it. It is
        None if the ring is out of sight.
        """
        if not self.in_sight(disk):
            return None
        if self._read_at != self.world.revision:
            self._readings = self._read()
            self._read_at = self.world.revision
        return self._readings[disk.number]

    def measured(self, number: int, measure: Callable[[], float]) -> float | None:
        """Return what is measured of a ring, None if the ring is out of sight."""
        return measure() if self.in_sight(self.disk(number)) else None

    def in_sight(self, disk: Disk) -> bool:
        """Return whether the camera sees a ring."""
        position, _ = self.world.pose(disk.name)
        return all(low < here < high for here, (low, high) in zip(position, SIGHT, strict=True))

    def distance(self, disk: Disk, peg: str) -> float:
        """Return the distance (m) of a ring's middle from the axis of a peg, seen from above."""
        (x, y, _), _ = self.world.pose(disk.name)
        return float(np.hypot(x - self.pegs[peg][0], y - self.pegs[peg][1]))

    def stack(self, disk: Disk) -> Stack:
        """Return how a ring and the rings under it lie. A ring that is around no peg, or in the
        hand, has none under it."""
        if self._stacked_at != self.world.revision:
            self._stacks = dict(self._stacked())
            self._stacked_at = self.world.revision
        return self._stacks.get(disk.number) or self._lies(disk, 0.0)

    def _stacked(self) -> Iterator[tuple[int, Stack]]:
        """Yield how each ring around a peg lies, with those under it."""
        for peg in PEGS:
            height, under, so_far = 0.0, len(self.disks) + 1, Stack(0.0, 0.0, 0)
            for disk in self.on_peg(peg):
                so_far = so_far.with_one(self._lies(disk, height), disk.number > under)
                yield disk.number, so_far
                height, under = height + disk.thickness, disk.number

    def _lies(self, disk: Disk, height: float) -> Stack:
        """Return how one ring lies. It should rest at this height (m)."""
        (_, _, z), (qx, qy, _, _) = self.world.pose(disk.name)
        upright = abs(1.0 - 2.0 * (qx * qx + qy * qy))  # upside down it is the same ring
        tilt = math.degrees(math.acos(min(upright, 1.0)))
        return Stack(abs(z - disk.thickness / 2 - height), tilt, 0)

    def on_peg(self, peg: str) -> list[Disk]:
        """Return the rings around a peg that are not held, at any height, lowest first."""
        (x, y), play = self.pegs[peg], REACH * self.size
        around = []
        for disk in self.disks:
            (px, py, pz), _ = self.world.pose(disk.name)
            if np.hypot(px - x, py - y) < play and self.world.fingers_on(disk.name) < 2:
                around.append((pz, disk.number, disk))
        return [disk for _, _, disk in sorted(around, key=lambda found: found[:2])]

    def _read(self) -> dict[int, str]:
        readings = dict.fromkeys((disk.number for disk in self.disks), NOWHERE)
        for disk in self.disks:
            if self.world.fingers_on(disk.name) == 2:
                readings[disk.number] = HELD
        for peg in PEGS:
            height, under = 0.0, len(self.disks) + 1
            for disk in self.on_peg(peg):
                if not (self._rests(disk, height) and disk.number < under):
                    break
                readings[disk.number] = peg
                height, under = height + disk.thickness, disk.number
        return readings

    def _rests(self, disk: Disk, height: float) -> bool:
        """Whether a ring lies flat with its lower side at this height (m)."""
        (_, _, z), (qx, qy, _, _) = self.world.pose(disk.name)
        flat = abs(1.0 - 2.0 * (qx * qx + qy * qy)) > TILT  # upside down it is the same ring
        return flat and abs(z - disk.thickness / 2 - height) < LEVEL * self.size

    def _places(self, pegs: Mapping[Disk, str]) -> Iterator[tuple[Disk, Vector]]:
        """Return the start position (m) of each ring: on its stack, moved from the middle of its
        peg by the jitter of the seed."""
        drawn = np.random.default_rng(self.seed).uniform(-JITTER, JITTER, (len(self.disks), 2))
        jitter, gap = drawn * self.size, 0.0005 * self.size
        height = dict.fromkeys(PEGS, gap)
        beside = iter(PEGS)
        for disk in reversed(self.disks):
            peg = pegs.get(disk, "")
            if peg == NOWHERE:
                y = self.pegs[next(beside, "c")][1]
                yield disk, (MIDDLE - 0.10 * self.size, y, disk.thickness / 2 + 2 * gap)
                continue
            if peg not in PEGS:
                raise WorldError(
                    f"disk {disk.number} cannot start on {peg!r}: there are the pegs a, b and c"
                )
            dx, dy = jitter[disk.number - 1].tolist()
            x, y = self.pegs[peg]
            yield disk, (x + dx, y + dy, height[peg] + disk.thickness / 2)
            height[peg] += disk.thickness + gap
