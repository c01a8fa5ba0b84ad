"""What a physical world is built of, as plain values: the plan that a fork builds again.

Lengths are metres, masses kilograms, forces newtons, angles radians.
"""

from __future__ import annotations

from dataclasses import dataclass

from smsl_studio.world.protocol import Quaternion, Vector

UPRIGHT: Quaternion = (0.0, 0.0, 0.0, 1.0)


@dataclass(frozen=True, slots=True)
class Capsule:
    """A round rod along z with round ends, centred; ``length`` is that of its straight part."""

    radius: float
    length: float


@dataclass(frozen=True, slots=True)
class Box:
    """A box, centred, given by its half lengths."""

    half: Vector


@dataclass(frozen=True, slots=True)
class Floor:
    """The half space below z = 0 of its own frame; it is not drawn."""


@dataclass(frozen=True, slots=True)
class Hulls:
    """A solid with holes, as convex pieces: OBJ text with one group a piece."""

    obj: str


@dataclass(frozen=True, slots=True)
class Body:
    """One rigid thing. Without mass it never moves; without a mesh it is not drawn."""

    name: str
    collision: Capsule | Box | Floor | Hulls
    position: Vector
    friction: float = 0.5
    mass: float = 0.0
    mesh: tuple[float, ...] = ()
    colour: Vector = (0.5, 0.5, 0.5)
    label: str = ""


@dataclass(frozen=True, slots=True)
class Robot:
    """An arm standing at the origin, with a two-finger gripper or none.

    ``urdf`` is a file in the folder of the engine's models, or a full path. ``tool`` is the link
    that is brought to places, ``rest`` the joints' posture at the start, ``fingers`` the two
    finger joints, ``opening`` their distance from the middle when open.
    """

    name: str
    urdf: str
    tool: str
    rest: tuple[float, ...]
    fingers: tuple[str, ...] = ()
    opening: float = 0.0
    friction: float = 0.5
