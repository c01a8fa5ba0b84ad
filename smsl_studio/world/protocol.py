"""What a world is: something that moves in ticks, can be put somewhere, and can be drawn.

Lengths are metres, times seconds of simulated time, angles radians, forces newtons; orientations
are quaternions (x, y, z, w).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Protocol

Vector = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]


@dataclass(frozen=True, slots=True)
class Shape:
    """One rigid thing to draw; its pose comes with the same index in ``World.poses``.

    ``mesh`` is a triangle soup in the shape's own frame: 9 floats a triangle, counter-clockwise.
    ``colour`` is red, green, blue in 0..1. ``label`` is drawn beside it where it is not empty.
    """

    name: str
    mesh: tuple[float, ...]
    colour: Vector
    label: str = ""


class World(Protocol):
    """What library code moves and senses. One tick is ``tick`` seconds of simulated time.

    ``snapshot``/``apply`` put a world back exactly; ``fork`` gives an independent copy for
    previews. ``set_facts`` and ``fact`` are what the table world has instead of physics.
    """

    name: str
    tick: float
    hardware: bool

    @property
    def time(self) -> float:
        """Simulated seconds since the world was built."""
        ...

    def step(self) -> None:
        """Advance by one tick."""
        ...

    def brake(self) -> None:
        """Hold every drive where it is: what a controlled stop does, within one tick."""
        ...

    def shapes(self) -> tuple[Shape, ...]:
        """What can be drawn, once, in the order of ``poses``; empty with nothing to see."""
        ...

    def poses(self) -> tuple[float, ...]:
        """7 floats a shape: position x, y, z and orientation x, y, z, w, in the world frame."""
        ...

    def status(self) -> Mapping[str, str]:
        """Short words for people beside the picture, such as ``{"gripper": "60 mm, 25 N"}``."""
        ...

    def snapshot(self) -> bytes:
        """Everything needed to come back to this instant."""
        ...

    def apply(self, snapshot: bytes) -> None:
        """Come back to the instant of a snapshot of the same build."""
        ...

    def fork(self) -> World:
        """An independent copy that starts at this instant."""
        ...

    def close(self) -> None:
        """Free what the world holds; calling it twice is harmless."""
        ...


Arguments = Mapping[str, Any]
