"""The reach of robots in a plugin's world: its stations, told for each robot as plain values."""

from __future__ import annotations

from typing import TYPE_CHECKING

from smsl_studio.errors import PluginError
from smsl_studio.library.arm_table import arm_named, arm_names
from smsl_studio.library.pattern import read_pattern
from smsl_studio.world.bodies import Robot
from smsl_studio.world.stations import Station

if TYPE_CHECKING:
    from smsl_studio.library.entries import StationsEntry
    from smsl_studio.library.operation_library import OperationLibrary
    from smsl_studio.world.stations import RobotReach


def reaches(library: OperationLibrary, entry: StationsEntry) -> dict[str, RobotReach]:
    """Return the reach of each robot of a world, by the robot's name; the name is empty in a world
    without a choice. Robots that other plugins register are left out.

    The result is empty where the files of robots are not installed. PluginError if the world has no
    robot, or if a pattern of operations cannot be read.
    """
    from smsl_studio.world.reach import reach_of

    found: dict[str, RobotReach] = {}
    for name, robot in _robots(library, entry).items():
        told = {text: tuple(own) for text, own in entry.function(robot).items()}
        for text, own in told.items():
            read_pattern(text, {})
            odd = next((one for one in own if not isinstance(one, Station)), None)
            if odd is not None:
                raise PluginError(f"the stations of {text} have a {type(odd).__name__!r}")
        reach = reach_of(robot, told)
        if reach is not None:
            found[name] = reach
    return found


def _robots(library: OperationLibrary, entry: StationsEntry) -> dict[str, Robot]:
    world = library.worlds.get(entry.world)
    if world is None:
        raise PluginError(f"there is no world {entry.world!r} for these stations")
    if entry.robot is not None:
        return {"": entry.robot}
    if not world.robots:
        raise PluginError(
            f"the stations of {entry.world!r} need a robot",
            advice="Name it: library.stations(world, robot=ARM).",
        )
    own = library.robots
    known = {name for name in world.robots if name in own or name in arm_names()}
    return {name: own.get(name) or arm_named(name) for name in world.robots if name in known}
