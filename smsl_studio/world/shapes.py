"""The shapes of a physical world's parts, and the body that carries each shape."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

from smsl_studio.world.bodies import Body, Robot
from smsl_studio.world.kinematics import rotation_of_rpy
from smsl_studio.world.links import description, link_shapes
from smsl_studio.world.meshes import moved, read_mesh, scaled, soup
from smsl_studio.world.protocol import Shape


def drawn(plan: Iterable[Body | Robot], models: Path) -> Iterator[tuple[str, Shape]]:
    """Yield the shapes of a plan, each with the name of the body or robot link that carries it.

    ``models`` is the folder of the URDF files.
    """
    for part in plan:
        if isinstance(part, Robot):
            yield from _links(part, models)
        elif part.mesh:
            yield part.name, Shape(part.name, part.mesh, part.colour, part.label)


def _links(robot: Robot, models: Path) -> Iterator[tuple[str, Shape]]:
    for visual in description(robot, models).visuals:
        rotation = rotation_of_rpy(visual.rpy)
        for colour, mesh in read_mesh(visual.mesh):
            placed = moved(scaled(mesh, visual.scale), rotation, visual.xyz)
            yield visual.link, Shape(visual.link, soup(placed), colour)
    yield from link_shapes(robot)
    if robot.mesh:
        yield robot.tool, Shape(f"{robot.name} tool", robot.mesh, robot.colour)
