"""The interface of a world: it moves in ticks, can be put into a state, and can be drawn.

Lengths are in metres, times in seconds of simulated time, angles in radians, forces in newtons.
Orientations are quaternions (x, y, z, w).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Protocol

Vector = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]


@dataclass(frozen=True, slots=True)
class Shape:
    """One rigid shape to draw. Its pose has the same index in ``World.poses``.

    ``mesh`` has 9 floats for each triangle, in metres in the shape's own frame, with corners
    counter-clockwise. ``colour`` is red, green and blue in 0..1. A ``label`` that is not empty is
    drawn beside the shape.
    """

    name: str
    mesh: tuple[float, ...]
    colour: Vector
    label: str = ""


class World(Protocol):
    """A world, which library code moves and senses. One tick is ``tick`` seconds of simulated time.

    ``snapshot`` and ``apply`` bring a world back exactly. ``fork`` makes an independent copy for
    previews. ``hardware`` says that real machines move.
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
        """Hold every drive at its position within one tick, for a controlled stop."""
        ...

    def shapes(self) -> tuple[Shape, ...]:
        """Return the shapes to draw, in the order of ``poses``. They do not change. The tuple may
        be empty."""
        ...

    def poses(self) -> tuple[float, ...]:
        """Return 7 floats for each shape: position x, y, z (m) and orientation x, y, z, w, in the
        frame of the world."""
        ...

    def status(self) -> Mapping[str, str]:
        """Return short texts for people, shown beside the picture, such as ``{"gripper": "60 mm, 25
        N"}``."""
        ...

    def snapshot(self) -> bytes:
        """Return all data that is needed to come back to this instant."""
        ...

    def apply(self, snapshot: bytes) -> None:
        """Go back to the instant of a snapshot of an equally built world."""
        ...

    def fork(self) -> World:
        """Return an independent copy that starts at this instant."""
        ...

    def close(self) -> None:
        """Free the resources of the world. A second call does nothing."""
        ...


Arguments = Mapping[str, Any]
