"""What a URDF file says about a robot: its joints and the meshes its links are drawn with.

Read here and not asked of the engine: the engine then need not load the drawing meshes at all.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from dataclasses import dataclass
from pathlib import Path

from smsl_studio.errors import WorldError
from smsl_studio.world.protocol import Vector

WHITE: Vector = (0.93, 0.93, 0.94)


@dataclass(frozen=True, slots=True)
class Joint:
    """One joint: its frame in the parent's (metres, roll-pitch-yaw in radians), axis and limits."""

    name: str
    kind: str
    parent: str
    child: str
    xyz: Vector
    rpy: Vector
    axis: Vector
    lower: float
    upper: float


@dataclass(frozen=True, slots=True)
class Visual:
    """One mesh a link is drawn with, placed in the link's frame."""

    link: str
    mesh: Path
    xyz: Vector
    rpy: Vector


@dataclass(frozen=True, slots=True)
class Urdf:
    """A robot as its file describes it; ``root`` is the link that nothing carries."""

    root: str
    joints: tuple[Joint, ...]
    visuals: tuple[Visual, ...]

    def chain(self, tip: str) -> tuple[Joint, ...]:
        """The joints from the root to a link, root first; WorldError for an unknown link."""
        above = {joint.child: joint for joint in self.joints}
        found: list[Joint] = []
        while tip != self.root:
            if tip not in above:
                raise WorldError(f"the robot has no link {tip!r}")
            found.append(above[tip])
            tip = above[tip].parent
        return tuple(reversed(found))


def read_urdf(path: Path) -> Urdf:
    """Read a URDF file; mesh names are relative to its folder (``package://`` is the same)."""
    robot = ET.parse(path).getroot()
    joints = tuple(_joint(element) for element in robot.findall("joint"))
    visuals = tuple(
        _visual(link.get("name", ""), visual, path.parent)
        for link in robot.findall("link")
        for visual in link.findall("visual")
        if visual.find("geometry/mesh") is not None
    )
    carried = {joint.child for joint in joints}
    roots = [link.get("name", "") for link in robot.findall("link")]
    return Urdf(next(name for name in roots if name not in carried), joints, visuals)


def _joint(element: ET.Element) -> Joint:
    limit = element.find("limit")
    xyz, rpy = _origin(element)
    return Joint(
        element.get("name", ""),
        element.get("type", "fixed"),
        _attribute(element, "parent", "link", ""),
        _attribute(element, "child", "link", ""),
        xyz,
        rpy,
        _vector(_attribute(element, "axis", "xyz", "1 0 0")),
        float(limit.get("lower", "0")) if limit is not None else 0.0,
        float(limit.get("upper", "0")) if limit is not None else 0.0,
    )


def _visual(link: str, element: ET.Element, folder: Path) -> Visual:
    mesh = element.find("geometry/mesh")
    name = mesh.get("filename", "") if mesh is not None else ""
    xyz, rpy = _origin(element)
    return Visual(link, folder / name.removeprefix("package://"), xyz, rpy)


def _origin(element: ET.Element) -> tuple[Vector, Vector]:
    return (
        _vector(_attribute(element, "origin", "xyz", "0 0 0")),
        _vector(_attribute(element, "origin", "rpy", "0 0 0")),
    )


def _attribute(element: ET.Element, child: str, name: str, default: str) -> str:
    found = element.find(child)
    return default if found is None else found.get(name, default)


def _vector(text: str) -> Vector:
    x, y, z = (float(part) for part in text.split())
    return (x, y, z)
