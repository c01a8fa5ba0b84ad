"""A robot in MuJoCo: its motors, its gripper, and its contacts, as ``manipulator`` has them.

Its world passes the engine's model and data, so this file does not import MuJoCo.
"""

from __future__ import annotations

import math
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from smsl_studio.errors import WorldError
from smsl_studio.world.bodies import Robot
from smsl_studio.world.kinematics import Arm
from smsl_studio.world.pose import check_amounts

Array = NDArray[np.float64]

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


class MujocoArm:
    """The arm and fingers of one robot. ``goal`` has the commanded angles of the arm's joints
    (rad)."""

    def __init__(self, world: Engine, robot: Robot, arm: Arm) -> None:
        self._world, self._plan = world, robot
        model = world.model
        joints = [model.joint(name) for name in (*arm.names, *robot.fingers)]
        self._places = [int(joint.qposadr[0]) for joint in joints]
        self._speeds_at = [int(joint.dofadr[0]) for joint in joints]
        self._motors = [int(model.actuator(joint.name).id) for joint in joints]
        self._count = len(arm.names)
        bodies = [int(joint.bodyid[0]) for joint in joints[self._count :]]
        self._hands = [set(world.geoms(body)) for body in bodies]
        self._seized: dict[int, float] = {}
        self._strongest = math.inf
        openings = [robot.opening] * len(robot.fingers)
        world.data.qpos[self._places] = [*robot.rest, *openings]
        self.drive(np.array(robot.rest))
        self.grip(robot.opening)

    # -- motors --------------------------------------------------------------------------------

    def drive(self, joints: Array, speeds: Array | None = None) -> None:
        """Move the arm's joints to the angles ``joints`` (rad), with the speeds ``speeds`` (rad/s)
        at this point. Without speeds the joints stop there.

        WorldError if there is not one finite number for each joint.
        """
        goal = self._one_each("angles", joints)
        self._speeds = np.zeros(len(goal)) if speeds is None else self._one_each("speeds", speeds)
        self.goal = goal
        # A motor brakes against its speed, so the wanted speed is added as a way.
        wanted = goal + DAMPING / STIFFNESS * self._speeds
        for joint, place in self._seized.items():
            wanted[joint] = place
        self._world.data.ctrl[self._motors[: self._count]] = wanted

    def _one_each(self, what: str, values: Array) -> Array:
        found = np.asarray(values, dtype=np.float64)
        if found.shape != (self._count,) or not np.isfinite(found).all():
            words = f"{what} of {self._plan.name!r} cannot be {found.tolist()!r}"
            raise WorldError(words, advice=f"It has {self._count} joints.")
        return found

    @property
    def size(self) -> float:
        """The size of the things that the hand is made for: 1 for those of a Panda."""
        return self._plan.size

    def grip(self, opening: float, force: float | None = None) -> None:
        """Move both fingers to ``opening`` (m) from the middle with at most ``force`` (N). Without
        one it is the usual force of the robot.

        WorldError if a number is not finite, or if the force is below 0.
        """
        force = self._plan.force if force is None else force
        check_amounts(self._plan.name, "the opening", [opening])
        check_amounts(self._plan.name, "the force", [force], least=0.0)
        self._grip = (opening, force)
        most = min(force, self._strongest)
        for motor in self._motors[self._count :]:
            self._world.data.ctrl[motor] = opening
            self._world.model.actuator_forcerange[motor] = (-most, most)

    def open(self) -> None:
        """Open the fingers as wide as the plan of the robot says."""
        self.grip(self._plan.opening)

    def brake(self) -> None:
        """Hold every joint at its position. Fingers that hold an object keep their force."""
        self.drive(self.joints())
        fingers = self._speeds_at[self._count :]
        if fingers and np.abs(self._world.data.qvel[fingers]).max() > 0.005:
            self.grip(self._opened(), self._grip[1])

    def seize(self, joint: int) -> None:
        """Block one joint of the arm (counted from 0): it ignores later commands.

        WorldError if the arm has no such joint.
        """
        if not 0 <= joint < self._count:
            raise WorldError(f"{self._plan.name!r} has no joint {joint}: they are counted from 0")
        self._seized[joint] = float(self.joints()[joint])
        self.drive(self.goal, self._speeds)

    def weaken(self, strongest: float) -> None:
        """Limit the force of the fingers to ``strongest`` (N) from now on. WorldError below 0."""
        check_amounts(self._plan.name, "the force", [strongest], least=0.0)
        self._strongest = strongest
        self.grip(*self._grip)

    # -- senses --------------------------------------------------------------------------------

    def joints(self) -> Array:
        """Return the angles of the arm's joints (rad)."""
        return np.array(self._world.data.qpos[self._places[: self._count]])

    def _opened(self) -> float:
        return float(np.mean(self._world.data.qpos[self._places[self._count :]]))

    def touching(self, geoms: set[int]) -> int:
        """Return the number of fingers that press on one of these shapes: 0, 1 or 2."""
        return sum(self._world.presses(hand, geoms) for hand in self._hands)

    def status(self) -> dict[str, str]:
        """Return the gripper's width (mm) and its commanded force (N) in words."""
        if len(self._places) == self._count:
            return {}
        return {"gripper": f"{2000 * self._opened():.0f} mm, {self._grip[1]:.0f} N"}

    # -- coming back ---------------------------------------------------------------------------

    def state(self) -> list[float]:
        """Return the commands of the motors as plain numbers, for ``restore``."""
        return [*self.goal.tolist(), *self._speeds.tolist(), *self._grip]

    def restore(self, state: list[Any]) -> None:
        """Go back to a ``state`` of the same robot."""
        count = self._count
        self.drive(np.array(state[:count]), np.array(state[count : 2 * count]))
        self.grip(*state[2 * count :])
