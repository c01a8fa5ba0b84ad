"""The parts of a physical world as plain values: the plan from which a fork is built.

Lengths are in metres, masses in kilograms, forces in newtons, angles in radians.
"""

from __future__ import annotations

from dataclasses import dataclass

from smsl_studio.world.protocol import Quaternion, Vector

UPRIGHT: Quaternion = (0.0, 0.0, 0.0, 1.0)


@dataclass(frozen=True, slots=True)
class Capsule:
    """A round rod along z with round ends, centred at the origin. ``length`` is the length of its
    straight part."""

    radius: float
    length: float


@dataclass(frozen=True, slots=True)
class Box:
    """A box, centred at the origin. ``half`` has half of its length along x, y and z."""

    half: Vector


@dataclass(frozen=True, slots=True)
class Floor:
    """The half space below z = 0 in its own frame. It is not drawn."""


@dataclass(frozen=True, slots=True)
class Hulls:
    """A solid with holes, made of convex pieces: OBJ text with one group for each piece."""

    obj: str


@dataclass(frozen=True, slots=True)
class Body:
    """One rigid body. A body without mass never moves. A body without a mesh is not drawn."""

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
    """An arm at the origin, with or without a gripper of two fingers.

    ``urdf`` is a file in the folder of the engine's models, or a full path. ``tool`` is the link
    that the kinematics moves. ``rest`` has the angles of the joints at the start. ``fingers`` are
    the two finger joints, and ``opening`` is their distance from the middle when they are open.

    ``point`` is the point that the kinematics moves, in the frame of the link ``tool``: the tip of
    a pointer, for example. ``mesh`` and ``colour`` are of what is mounted on this link.
    """

    name: str
    urdf: str
    tool: str
    rest: tuple[float, ...]
    fingers: tuple[str, ...] = ()
    opening: float = 0.0
    friction: float = 0.5
    point: Vector = (0.0, 0.0, 0.0)
    mesh: tuple[float, ...] = ()
    colour: Vector = (0.5, 0.5, 0.5)
