"""The codec of a robot's reach: its joints and the stations of its work, as plain numbers."""

from __future__ import annotations

from typing import Final

from smsl_studio.host.codec import Codec, exactly, number, numbers, one_of
from smsl_studio.host.compound import record, row, several
from smsl_studio.host.vocabulary import name, sentence
from smsl_studio.world.stations import RobotReach, Station
from smsl_studio.world.urdf import Joint

FARTHEST: Final = 1e4
"""The largest length (m) and angle (rad) that is sent."""

JOINTS, STATIONS = 100, 200
"""The largest number of joints of a robot, and of its stations in a world."""

VECTOR = exactly(-FARTHEST, FARTHEST, 3)
TEXT = name(300, empty=True)
KINDS = ("fixed", "revolute", "continuous", "prismatic", "floating", "planar")

JOINT: Codec[Joint] = record(
    Joint,
    name=TEXT,
    kind=one_of(KINDS),
    parent=TEXT,
    child=TEXT,
    xyz=VECTOR,
    rpy=VECTOR,
    axis=VECTOR,
    lower=number(-FARTHEST, FARTHEST),
    upper=number(-FARTHEST, FARTHEST),
)

STATION: Codec[Station] = record(
    Station, name=sentence(200), position=VECTOR, rotation=exactly(-1.0, 1.0, 9)
)

REACH: Codec[RobotReach] = record(
    RobotReach,
    robot=TEXT,
    joints=several(JOINT, JOINTS),
    rest=numbers(-FARTHEST, FARTHEST, JOINTS),
    base=VECTOR,
    stations=several(row(name(500), STATION), STATIONS),
)
