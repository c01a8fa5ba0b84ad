"""The links of robots that no file describes: their joints, their text for the engine, and what is
drawn of them."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterator
from pathlib import Path

from smsl_studio.world.bodies import Box, Robot, RobotLink, Solid
from smsl_studio.world.kinematics import rotation_of_rpy
from smsl_studio.world.meshes import Mesh, capsule, moved, rounded_box, soup
from smsl_studio.world.protocol import Shape, Vector
from smsl_studio.world.urdf import Joint, Urdf, read_urdf

GYRATION = 0.1
"""The radius (m) at which the mass of a link counts. It is large for small links, so that their
motors are steady."""


def description(robot: Robot, models: Path) -> Urdf:
    """Return the joints of a robot and the meshes of its file. ``models`` is the folder of the
    URDF files."""
    file = read_urdf(models / robot.urdf) if robot.urdf else None
    own = tuple(_joint(link) for link in robot.links if link.parent)
    if file is None:
        return Urdf(robot.links[0].name, own, ())
    return Urdf(file.root, file.joints + own, file.visuals)


def urdf_text(robot: Robot, models: Path) -> str:
    """Return a whole URDF text of a robot with links of its own, for the engine."""
    if robot.urdf:
        file = models / robot.urdf
        root = ET.parse(file).getroot()
        for mesh in root.iter("mesh"):
            name = mesh.get("filename", "").removeprefix("package://")
            mesh.set("filename", str(file.parent / name))
    else:
        root = ET.Element("robot", name=robot.name)
    for link in robot.links:
        root.append(_link_element(link))
        if link.parent:
            root.append(_joint_element(link))
    return ET.tostring(root, encoding="unicode")


def link_shapes(robot: Robot) -> Iterator[tuple[str, Shape]]:
    """Yield what is drawn of the own links of a robot, each with the name of its link."""
    for link in robot.links:
        for solid in link.solids:
            yield link.name, Shape(link.name, soup(_mesh(solid)), solid.colour)


def _mesh(solid: Solid) -> Mesh:
    shape = solid.shape
    if isinstance(shape, Box):
        plain = rounded_box(shape.half)
    else:
        plain = capsule(shape.radius, shape.length)
    return moved(plain, rotation_of_rpy(solid.rpy), solid.xyz)


def _joint(link: RobotLink) -> Joint:
    return Joint(
        link.name, link.kind, link.parent, link.name, link.xyz, link.rpy, link.axis, *link.limits
    )


def _link_element(link: RobotLink) -> ET.Element:
    element = ET.Element("link", name=link.name)
    inertial = ET.SubElement(element, "inertial")
    ET.SubElement(inertial, "mass", value=repr(link.mass))
    own = repr(link.mass * GYRATION**2)
    ET.SubElement(inertial, "inertia", ixx=own, ixy="0", ixz="0", iyy=own, iyz="0", izz=own)
    for solid in link.solids:
        if solid.hard:
            collision = ET.SubElement(element, "collision")
            ET.SubElement(collision, "origin", xyz=_text(solid.xyz), rpy=_text(solid.rpy))
            geometry = ET.SubElement(collision, "geometry")
            if isinstance(solid.shape, Box):
                x, y, z = solid.shape.half
                ET.SubElement(geometry, "box", size=_text((2 * x, 2 * y, 2 * z)))
            else:
                shape = solid.shape
                ET.SubElement(
                    geometry, "capsule", radius=repr(shape.radius), length=repr(shape.length)
                )
    return element


def _joint_element(link: RobotLink) -> ET.Element:
    element = ET.Element("joint", name=link.name, type=link.kind)
    ET.SubElement(element, "parent", link=link.parent)
    ET.SubElement(element, "child", link=link.name)
    ET.SubElement(element, "origin", xyz=_text(link.xyz), rpy=_text(link.rpy))
    ET.SubElement(element, "axis", xyz=_text(link.axis))
    low, high = link.limits
    effort = repr(link.effort)
    ET.SubElement(element, "limit", lower=repr(low), upper=repr(high), effort=effort, velocity="10")
    return element


def _text(values: Vector) -> str:
    return " ".join(map(repr, values))
