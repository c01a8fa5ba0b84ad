"""A robot in an engine: its motors, its gripper, and its contacts.

``engine`` is a client of PyBullet, which ``bullet`` passes. So this file does not import PyBullet.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from smsl_studio.errors import WorldError
from smsl_studio.world.bodies import UPRIGHT, Robot
from smsl_studio.world.kinematics import Arm
from smsl_studio.world.protocol import Quaternion, Vector
from smsl_studio.world.robot_motors import Array, RobotMotors
from smsl_studio.world.urdf import Urdf

Pose = tuple[Vector, Quaternion]

GAIN = 0.5
"""The share of its position error that a joint corrects in one tick."""

FINGER_GAIN, JAW_GAIN = 0.1, 1.0
"""The same of a finger that slides (the engine's own default), and of one that turns. The small
things that a jaw holds are so light that a gentle finger would let them slip."""


class Manipulator(RobotMotors):
    """The arm and fingers of one robot, with the motors of PyBullet."""

    def __init__(self, engine: Any, robot: Robot, file: Path, urdf: Urdf, arm: Arm) -> None:
        super().__init__(robot, len(arm.names))
        self._engine, self._urdf = engine, urdf
        flags = engine.URDF_IGNORE_VISUAL_SHAPES
        self.body = int(
            engine.loadURDF(str(file), basePosition=robot.base, useFixedBase=True, flags=flags)
        )
        infos = [engine.getJointInfo(self.body, i) for i in range(engine.getNumJoints(self.body))]
        joints = {info[1].decode(): index for index, info in enumerate(infos)}
        self._links = {info[12].decode(): index for index, info in enumerate(infos)}
        self._arm = [joints[name] for name in arm.names]
        self._forces = [infos[index][10] for index in self._arm]
        for name in robot.fingers:
            if name not in joints:
                known = ", ".join(map(repr, joints))
                words = f"the robot {robot.name!r} has no joint {name!r} for a finger"
                raise WorldError(words, advice=f"Its joints are {known}.")
        self._fingers = [joints[name] for name in robot.fingers]
        for index in self._fingers:
            engine.changeDynamics(self.body, index, lateralFriction=robot.friction)
        if self._fingers:
            self._gear()
        self._start()

    def _gear(self) -> None:
        """Keep both fingers at the same distance from the middle, as the gear of a real gripper
        does."""
        left, right = self._fingers
        axis, origin = [1, 0, 0], [0, 0, 0]
        kind = self._engine.JOINT_GEAR
        gear = self._engine.createConstraint(
            self.body, left, self.body, right, kind, axis, origin, origin
        )
        self._engine.changeConstraint(gear, gearRatio=-1, erp=0.1, maxForce=50)

    def _start(self) -> None:
        opening = self._plan.opening
        finger = self._finger(opening)
        positions = [*self._plan.rest, *(finger for _ in self._fingers)]
        for index, position in zip(self._arm + self._fingers, positions, strict=True):
            self._engine.resetJointState(self.body, index, position)
        self.drive(np.array(self._plan.rest))
        self.grip(opening)

    # -- motors --------------------------------------------------------------------------------

    def _drive(self) -> None:
        self._engine.setJointMotorControlArray(
            self.body,
            self._arm,
            self._engine.POSITION_CONTROL,
            targetPositions=[self._seized.get(i, goal) for i, goal in enumerate(self.goal)],
            targetVelocities=[
                0.0 if i in self._seized else speed for i, speed in enumerate(self._speeds)
            ],
            forces=self._forces,
            positionGains=[GAIN] * len(self.goal),
            velocityGains=[1.0] * len(self.goal),
        )

    def _press(self, opening: float, force: float) -> None:
        for joint in self._fingers:
            self._engine.setJointMotorControl2(
                self.body,
                joint,
                self._engine.POSITION_CONTROL,
                targetPosition=self._finger(opening),
                force=force * self._lever,
                positionGain=FINGER_GAIN if self._plan.jaw is None else JAW_GAIN,
            )

    def _finger(self, opening: float) -> float:
        """Return the position of a finger's joint for a distance (m) from the middle."""
        return opening if self._plan.jaw is None else self._plan.jaw.angle(opening)

    @property
    def _lever(self) -> float:
        """What makes the force of a finger that of its joint."""
        return 1.0 if self._plan.jaw is None else self._plan.jaw.length

    # -- senses --------------------------------------------------------------------------------

    def _states(self) -> Array:
        """Return position and speed, one row for each joint: first the arm, then the fingers.

        The shape is (joints, 2). Units are rad and rad/s for the arm, m and m/s for fingers.
        """
        states = self._engine.getJointStates(self.body, self._arm + self._fingers)
        return np.array([state[:2] for state in states])

    def joints(self) -> Array:
        """Return the angles of the arm's joints (rad)."""
        return self._states()[: len(self._arm), 0]

    def touching(self, body: int) -> int:
        """Return the number of fingers that press on a body: 0, 1 or 2."""
        contacts = (
            self._engine.getContactPoints(self.body, body, joint, -1) for joint in self._fingers
        )
        return sum(any(contact[9] > 0.0 for contact in found) for found in contacts)

    def frames(self) -> dict[str, Pose]:
        """Return the frame of each link by its name: position (m) and quaternion (x, y, z, w)."""
        indices = list(self._links.values())
        states = self._engine.getLinkStates(self.body, indices, computeForwardKinematics=True)
        frames: dict[str, Pose] = {self._urdf.root: (self._plan.base, UPRIGHT)}
        return frames | {
            name: (state[4], state[5]) for name, state in zip(self._links, states, strict=True)
        }

    def _opened(self) -> float:
        position = float(self._states()[len(self._arm) :, 0].mean())
        return position if self._plan.jaw is None else self._plan.jaw.opening(position)

    def _finger_speeds(self) -> Array:
        return self._states()[len(self._arm) :, 1]

    # -- coming back ---------------------------------------------------------------------------

    def state(self) -> list[float]:
        """Return angles, speeds and commands of the motors as plain numbers, for ``restore``."""
        return [*self._states().ravel().tolist(), *self._commands()]

    def restore(self, state: list[float]) -> None:
        """Go back to a ``state`` of the same robot."""
        every = self._arm + self._fingers
        for row, joint in enumerate(every):
            self._engine.resetJointState(self.body, joint, *state[2 * row : 2 * row + 2])
        self._command(state[2 * len(every) :])
