"""The parts of a physical world as plain values: the plan from which a fork is built.

Lengths are in metres, masses in kilograms, forces in newtons, angles in radians.
"""

from __future__ import annotations

import math
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
class Solid:
    """A convex piece of a robot's link, at a place in the link's frame (roll, pitch, yaw in
    radians). A piece that is not ``hard`` is drawn, and touches nothing."""

    shape: Capsule | Box
    xyz: Vector = (0.0, 0.0, 0.0)
    rpy: Vector = (0.0, 0.0, 0.0)
    colour: Vector = (0.75, 0.77, 0.80)
    hard: bool = False


@dataclass(frozen=True, slots=True)
class RobotLink:
    """A link of a robot that no file describes, and the joint that carries it on its ``parent``.

    ``kind`` is that of the joint as in URDF: fixed, revolute or prismatic. ``xyz``, ``rpy`` and
    ``axis`` are its frame in the parent's frame and its axis. ``limits`` are the least and the
    greatest angle (rad) or way (m), ``effort`` its greatest torque (Nm) or force (N).
    """

    name: str
    parent: str = ""
    kind: str = "fixed"
    xyz: Vector = (0.0, 0.0, 0.0)
    rpy: Vector = (0.0, 0.0, 0.0)
    axis: Vector = (0.0, 0.0, 1.0)
    limits: tuple[float, float] = (0.0, 0.0)
    effort: float = 0.0
    mass: float = 0.1
    solids: tuple[Solid, ...] = ()


@dataclass(frozen=True, slots=True)
class Jaw:
    """Fingers that turn, in place of fingers that slide. ``length`` is from their axis to the tool
    point, ``apart`` the distance of each finger from the middle there at the angle 0."""

    length: float
    apart: float

    def angle(self, opening: float) -> float:
        """Return the angle (rad) of a finger at a distance (m) from the middle."""
        share = opening / math.hypot(self.apart, self.length)
        return math.asin(max(-1.0, min(1.0, share))) - math.atan2(self.apart, self.length)

    def opening(self, angle: float) -> float:
        """Return the distance (m) of a finger from the middle at an angle (rad)."""
        return self.apart * math.cos(angle) + self.length * math.sin(angle)


@dataclass(frozen=True, slots=True)
class Robot:
    """An arm, with or without a gripper of two fingers: all that a world needs to know of it.

    ``urdf`` is a file in the folder of the engine's models, or a full path. ``links`` are added to
    it; without a file they are the whole robot, root first. ``tool`` is the link that the
    kinematics moves. Its z axis points out of the hand, and the fingers close along its y axis.
    ``rest`` has the angles of the joints at the start. ``fingers`` are the two finger joints, and
    ``opening`` is their distance from the middle when they are open. ``force`` is the usual force
    of a finger. Fingers slide, or turn as a ``jaw``.

    ``point`` is the point that the kinematics moves, in the frame of the link ``tool``: the tip of
    a pointer, for example. ``mesh`` and ``colour`` are of what is mounted on this link. ``base`` is
    where the robot stands. ``size`` is the size of the things that its hand is made for: 1 for
    those of a Panda. Worlds make their things, and the ways between them, that much smaller.
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
    links: tuple[RobotLink, ...] = ()
    force: float = 25.0
    jaw: Jaw | None = None
    base: Vector = (0.0, 0.0, 0.0)
    size: float = 1.0
