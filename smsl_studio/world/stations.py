"""Stations: the places to which operations bring a tool, as plain values for each robot. ``reach``
says which of them a robot does not reach."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from smsl_studio.world.protocol import Vector
from smsl_studio.world.urdf import Joint

Rotation = tuple[float, float, float, float, float, float, float, float, float]

DOWN: Rotation = (1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, -1.0)
"""The rotation of a tool that points down, row by row."""


@dataclass(frozen=True, slots=True)
class Station:
    """A place to which an operation brings the tool: its name for people, its position (m), and the
    rotation of the tool there, row by row."""

    name: str
    position: Vector
    rotation: Rotation = DOWN


Stations = Mapping[str, Iterable[Station]]
"""The stations of operations, by a pattern of their names such as ``Op_{disk}a``."""


@dataclass(frozen=True, slots=True)
class RobotReach:
    """What the answer needs of one robot in one world: its joints from the base to the tool, its
    rest posture (rad), where its base stands (m), and pairs of a pattern of operations and a
    station."""

    robot: str
    joints: tuple[Joint, ...]
    rest: tuple[float, ...]
    base: Vector
    stations: tuple[tuple[str, Station], ...]
