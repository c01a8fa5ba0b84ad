"""The commands of a robot that every engine takes: checks of the numbers, what was commanded last,
joints that are seized, and the greatest force of the fingers. An engine adds its motors."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod

import numpy as np
from numpy.typing import NDArray

from smsl_studio.errors import WorldError
from smsl_studio.world.bodies import Robot
from smsl_studio.world.pose import check_amounts

Array = NDArray[np.float64]


class RobotMotors(ABC):
    """The arm and fingers of one robot. ``goal`` has the commanded angles of the arm's joints
    (rad)."""

    goal: Array

    def __init__(self, robot: Robot, joints: int) -> None:
        self._plan, self._joint_count = robot, joints
        self._seized: dict[int, float] = {}
        self._strongest = math.inf

    # -- what an engine adds -------------------------------------------------------------------

    @abstractmethod
    def joints(self) -> Array:
        """Return the angles of the arm's joints (rad)."""

    @abstractmethod
    def _drive(self) -> None:
        """Command the motors of the arm: ``goal`` with ``_speeds``, and ``_seized`` joints."""

    @abstractmethod
    def _press(self, opening: float, force: float) -> None:
        """Command the motors of the fingers: a distance (m) from the middle, with at most a force
        (N)."""

    @abstractmethod
    def _opened(self) -> float:
        """Return the real distance (m) of the fingers from the middle."""

    @abstractmethod
    def _finger_speeds(self) -> Array:
        """Return the speeds of the fingers' joints (m/s or rad/s). Empty without fingers."""

    # -- motors --------------------------------------------------------------------------------

    def drive(self, joints: Array, speeds: Array | None = None) -> None:
        """Move the arm's joints to the angles ``joints`` (rad), with the speeds ``speeds`` (rad/s)
        at this point. Without speeds the joints stop there.

        WorldError if there is not one finite number for each joint.
        """
        goal = self._one_each("angles", joints)
        self._speeds = np.zeros(len(goal)) if speeds is None else self._one_each("speeds", speeds)
        self.goal = goal
        self._drive()

    def _one_each(self, what: str, values: Array) -> Array:
        found = np.asarray(values, dtype=np.float64)
        if found.shape != (self._joint_count,) or not np.isfinite(found).all():
            words = f"{what} of {self._plan.name!r} cannot be {found.tolist()!r}"
            raise WorldError(words, advice=f"It has {self._joint_count} joints.")
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
        self._press(opening, min(force, self._strongest))

    def open(self) -> None:
        """Open the fingers as wide as the plan of the robot says."""
        self.grip(self._plan.opening)

    def brake(self) -> None:
        """Hold every joint at its position. Fingers that hold an object keep their force."""
        joints, fingers, opened = self.joints(), self._finger_speeds(), 0.0
        moving = len(fingers) and np.abs(fingers).max() > 0.005
        if moving:
            opened = self._opened()
        self.drive(joints)
        if moving:
            self.grip(opened, self._grip[1])

    def seize(self, joint: int) -> None:
        """Block one joint of the arm (counted from 0): it ignores later commands.

        WorldError if the arm has no such joint.
        """
        if not 0 <= joint < self._joint_count:
            raise WorldError(f"{self._plan.name!r} has no joint {joint}: they are counted from 0")
        self._seized[joint] = float(self.joints()[joint])
        self.drive(self.goal, self._speeds)

    def weaken(self, strongest: float) -> None:
        """Limit the force of the fingers to ``strongest`` (N) from now on. WorldError below 0."""
        check_amounts(self._plan.name, "the force", [strongest], least=0.0)
        self._strongest = strongest
        self.grip(*self._grip)

    # -- for people, and for coming back -------------------------------------------------------

    def status(self) -> dict[str, str]:
        """Return the gripper's width (mm) and its commanded force (N) in words."""
        if not self._plan.fingers:
            return {}
        return {"gripper": f"{2000 * self._opened():.0f} mm, {self._grip[1]:.0f} N"}

    def _commands(self) -> list[float]:
        """Return the commands of the motors as plain numbers, for ``_command``."""
        return [*self.goal.tolist(), *self._speeds.tolist(), *self._grip]

    def _command(self, told: list[float]) -> None:
        """Give the commands of ``_commands`` again."""
        count = self._joint_count
        self.drive(np.array(told[:count]), np.array(told[count : 2 * count]))
        self.grip(*told[2 * count :])
