"""What physical worlds share, whatever their engine: the plan of parts and its checks, simulated
time, the robot's kinematics, what is drawn, and the words for people."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping
from pathlib import Path

from smsl_studio.errors import WorldError
from smsl_studio.world import shapes as drawing
from smsl_studio.world.bodies import Body, Robot
from smsl_studio.world.kinematics import Arm
from smsl_studio.world.models import models_folder
from smsl_studio.world.pose import check_amounts, check_position
from smsl_studio.world.protocol import Shape
from smsl_studio.world.rest import CALM, refuse_overlaps, restless
from smsl_studio.world.robot_motors import RobotMotors

MODELS = models_folder() or Path()
"""The folder of the models of robots, such as ``franka_panda/panda.urdf``."""


class PlannedWorld(ABC):
    """Rigid bodies and at most one robot, in ticks of 1/240 s."""

    tick = 1.0 / 240.0
    hardware = False

    def __init__(self, name: str) -> None:
        self.name = name
        self.revision = 0
        """A number that grows when a body may have moved. Poses that were read before are then
        outdated."""
        self._plan: list[Body | Robot] = []
        self._arm: Arm | None = None
        self._carriers: tuple[str, ...] | None = None
        self._ticks = 0

    @property
    @abstractmethod
    def robot(self) -> RobotMotors:
        """The robot's motors and sensors. WorldError in a world without a robot."""

    @abstractmethod
    def fingers_on(self, name: str) -> int:
        """Return the number of the robot's fingers that press on a body: 0, 1 or 2."""

    @abstractmethod
    def step(self) -> None:
        """Advance the world by one tick of 1/240 s."""

    @abstractmethod
    def speed(self, name: str) -> float:
        """Return the speed of a body (m/s), its rotation included."""

    @abstractmethod
    def _contacts(self) -> Iterator[tuple[float, str, str]]:
        """Yield how deep (m) bodies are in each other, with their names in order."""

    def _come_to_rest(self, limit: float) -> None:
        """Step until all bodies are at rest.

        WorldError if two bodies are in one place, or if a body still moves after ``limit`` seconds.
        """
        before, calm = self._ticks, 0
        while calm < 12 and (self._ticks - before) * self.tick < limit:
            self.step()
            if self._ticks == before + 1:
                refuse_overlaps(self.name, self._contacts())
            calm = calm + 1 if all(self.speed(name) < CALM for name in self._loose()) else 0
        if calm < 12:
            raise restless(self.name, {name: self.speed(name) for name in self._loose()}, limit)

    def _check(self, part: Body | Robot) -> None:
        """WorldError if a part cannot be added: for a name that exists already, a second robot, or
        numbers that are not valid."""
        if any(part.name == other.name for other in self._plan):
            raise WorldError(f"{part.name!r} stands in the world already")
        if isinstance(part, Body):
            check_position(part.name, part.position)
            check_amounts(part.name, "mass and friction", (part.mass, part.friction), least=0.0)
            return
        if any(isinstance(other, Robot) for other in self._plan):
            raise WorldError(f"{part.name!r} cannot be added: the world has a robot already")
        check_amounts(part.name, "the rest posture", part.rest)
        check_position(part.name, part.point)
        check_position(part.name, part.base)
        check_amounts(part.name, "opening and friction", (part.opening, part.friction), 0.0)

    @property
    def time(self) -> float:
        """The simulated time (s)."""
        return self._ticks * self.tick

    @property
    def arm(self) -> Arm:
        """The robot's kinematics. WorldError in a world without a robot."""
        if self._arm is None:
            raise self._no_robot()
        return self._arm

    def _no_robot(self) -> WorldError:
        return WorldError(f"there is no robot in the world {self.name!r}")

    def brake(self) -> None:
        """Stop the robot if there is one."""
        if self._arm is not None:
            self.robot.brake()

    def _loose(self) -> list[str]:
        return [part.name for part in self._plan if isinstance(part, Body) and part.mass > 0]

    def status(self) -> Mapping[str, str]:
        """Return the held body and the state of the gripper, for people. It is empty without a
        robot."""
        if self._arm is None:
            return {}
        held = [name for name in self._loose() if self.fingers_on(name) == 2]
        holding = {"holding": held[0].replace("_", " ")} if held else {}
        return {**holding, **self.robot.status()}

    def shapes(self) -> tuple[Shape, ...]:
        """Return all shapes to draw: meshes (m), each in the frame of its body."""
        drawn = tuple(drawing.drawn(self._plan, MODELS))
        self._carriers = tuple(name for name, _ in drawn)
        return tuple(shape for _, shape in drawn)
