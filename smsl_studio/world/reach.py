"""Whether a robot reaches the places of its work, asked before anything moves: by inspection when a
world is chosen (R24), and once more by a world while it is built.

A plugin tells its stations for each robot. Its code is not needed for the answer: the joints of the
robot, which are plain values, and the kinematics are enough.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from smsl_studio.errors import WorldError
from smsl_studio.stop import heed
from smsl_studio.world.kinematics import Arm
from smsl_studio.world.links import description
from smsl_studio.world.models import models_folder
from smsl_studio.world.stations import RobotReach, Station, Stations

if TYPE_CHECKING:
    from smsl_studio.world.bodies import Robot
    from smsl_studio.world.bullet import BulletWorld


def reach_of(robot: Robot, stations: Stations) -> RobotReach | None:
    """Return the reach of a robot with these stations. None if the folder of models is not there.
    WorldError for a robot without the link ``tool``."""
    folder = models_folder()
    if folder is None:
        return None
    joints = description(robot, folder).chain(robot.tool, robot.point)
    pairs = tuple((pattern, place) for pattern, own in stations.items() for place in own)
    return RobotReach(robot.name, joints, robot.rest, robot.base, pairs)


@lru_cache(maxsize=32)
def unreached(reach: RobotReach) -> tuple[tuple[str, str], ...]:
    """Return a pair for each station that the robot does not reach: the pattern of the operations,
    and what is not reached, in words."""
    arm = Arm(reach.joints, reach.rest, reach.base)
    every = dict.fromkeys(place for _, place in reach.stations)
    missed = {place: f"{place.name} {_where(place)}" for place in _missed(arm, every)}
    return tuple((pattern, missed[one]) for pattern, one in reach.stations if one in missed)


def refuse_unreached(world: BulletWorld, robot: str, places: Iterable[Station]) -> None:
    """Raise WorldError if the robot, whose name is ``robot``, does not reach a station."""
    for place in _missed(world.arm, places):
        words = f"the robot {robot!r} does not reach {place.name} of the world {world.name!r}"
        raise WorldError(
            f"{words} {_where(place)}",
            advice="Choose another robot, or stand it elsewhere (base).",
        )


def _missed(arm: Arm, places: Iterable[Station]) -> Iterator[Station]:
    """Yield the places that an arm does not reach.

    Each place is first sought from the rest posture, then from the place before it.
    """
    near = arm.rest
    for place in places:
        heed()
        rotation = np.array(place.rotation).reshape(3, 3)
        for start in (arm.rest, near):
            try:
                near = arm.solve(np.array(place.position), rotation, near=start)
                break
            except (WorldError, np.linalg.LinAlgError):
                continue
        else:
            yield place


def _where(place: Station) -> str:
    return f"({', '.join(f'{value:.3f}' for value in place.position)} m)"
