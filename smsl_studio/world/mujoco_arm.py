"""A robot in MuJoCo: its motors, its gripper, and its contacts, as ``manipulator`` has them.

Its world passes the engine's model and data, so this file does not import MuJoCo.
"""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np

from smsl_studio.world.bodies import Robot
from smsl_studio.world.kinematics import Arm
from smsl_studio.world.robot_motors import Array, RobotMotors

STIFFNESS, DAMPING = 8000.0, 400.0
"""The stiffness (Nm/rad, N/m) and damping (Nms/rad, Ns/m) of the motors of an arm."""

FINGER_STIFFNESS, FINGER_DAMPING = 8000.0, 200.0
"""The same for the motors of fingers."""


class Engine(Protocol):
    """What an arm needs of its world: the engine's model and state, and what touches what."""

    @property
    def model(self) -> Any: ...

    @property
    def data(self) -> Any: ...

    def geoms(self, body: int) -> list[int]:
        """Return the numbers of the shapes of a body."""
        ...

    def presses(self, one: set[int], other: set[int]) -> bool:
        """Whether a shape of ``one`` presses on a shape of ``other``."""
        ...


class MujocoArm(RobotMotors):
    """The arm and fingers of one robot, with the motors of MuJoCo."""

    def __init__(self, world: Engine, robot: Robot, arm: Arm) -> None:
        super().__init__(robot, len(arm.names))
        self._world = world
        model = world.model
        joints = [model.joint(name) for name in (*arm.names, *robot.fingers)]
        self._places = [int(joint.qposadr[0]) for joint in joints]
        self._speeds_at = [int(joint.dofadr[0]) for joint in joints]
        self._motors = [int(model.actuator(joint.name).id) for joint in joints]
        self._count = len(arm.names)
        bodies = [int(joint.bodyid[0]) for joint in joints[self._count :]]
        self._hands = [set(world.geoms(body)) for body in bodies]
        openings = [robot.opening] * len(robot.fingers)
        world.data.qpos[self._places] = [*robot.rest, *openings]
        self.drive(np.array(robot.rest))
        self.grip(robot.opening)

    # -- motors --------------------------------------------------------------------------------

    def _drive(self) -> None:
        # A motor brakes against its speed, so the wanted speed is added as a way.
        wanted = self.goal + DAMPING / STIFFNESS * self._speeds
        for joint, place in self._seized.items():
            wanted[joint] = place
        self._world.data.ctrl[self._motors[: self._count]] = wanted

    def _press(self, opening: float, force: float) -> None:
        for motor in self._motors[self._count :]:
            self._world.data.ctrl[motor] = opening
            self._world.model.actuator_forcerange[motor] = (-force, force)

    # -- senses --------------------------------------------------------------------------------

    def joints(self) -> Array:
        """Return the angles of the arm's joints (rad)."""
        return np.array(self._world.data.qpos[self._places[: self._count]])

    def _opened(self) -> float:
        return float(np.mean(self._world.data.qpos[self._places[self._count :]]))

    def touching(self, geoms: set[int]) -> int:
        """Return the number of fingers that press on one of these shapes: 0, 1 or 2."""
        return sum(self._world.presses(hand, geoms) for hand in self._hands)

    def _finger_speeds(self) -> Array:
        return np.array(self._world.data.qvel[self._speeds_at[self._count :]])

    # -- coming back ---------------------------------------------------------------------------

    def state(self) -> list[float]:
        """Return the commands of the motors as plain numbers, for ``restore``."""
        return self._commands()

    def restore(self, state: list[float]) -> None:
        """Go back to a ``state`` of the same robot."""
        self._command(state)
