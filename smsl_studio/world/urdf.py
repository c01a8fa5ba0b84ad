"""The content of a URDF file: the joints of a robot and the meshes of its links.

It is read here and not by the engine, so that the engine need not load the meshes for drawing.
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
    """One joint: its frame in the parent's frame (metres; roll, pitch, yaw in radians), its axis
    and its limits."""

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
    """One mesh of a link, with its pose in the link's frame (metres; roll, pitch, yaw in
    radians). ``scale`` multiplies the numbers of the mesh file."""

    link: str
    mesh: Path
    xyz: Vector
    rpy: Vector
    scale: Vector = (1.0, 1.0, 1.0)


@dataclass(frozen=True, slots=True)
class Urdf:
    """The description of a robot in its file. ``root`` is the link without a parent."""

    root: str
    joints: tuple[Joint, ...]
    visuals: tuple[Visual, ...]

    def chain(self, tip: str, point: Vector = (0.0, 0.0, 0.0)) -> tuple[Joint, ...]:
        """Return the joints from the root to the link ``tip``, in this order. WorldError for an
        unknown link.

        A ``point`` (m) in the frame of this link becomes a fixed joint at the end.
        """
        link = tip
        above = {joint.child: joint for joint in self.joints}
        found: list[Joint] = []
        while tip != self.root:
            if tip not in above:
                raise WorldError(f"the robot has no link {tip!r}")
            found.append(above[tip])
            tip = above[tip].parent
        chain = tuple(reversed(found))
        if not any(point):
            return chain
        name, none = f"{link}_point", (0.0, 0.0, 0.0)
        return (*chain, Joint(name, "fixed", link, name, point, none, (1.0, 0.0, 0.0), 0.0, 0.0))


def read_urdf(path: Path) -> Urdf:
    """Read a URDF file. Mesh names are relative to its folder; ``package://`` means this folder,
    too."""
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
    scale = mesh.get("scale", "1 1 1") if mesh is not None else "1 1 1"
    xyz, rpy = _origin(element)
    return Visual(link, folder / name.removeprefix("package://"), xyz, rpy, _vector(scale))


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
