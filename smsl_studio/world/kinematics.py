"""The kinematics of an arm: from joints to the pose of the tool, and back. It needs no engine.

It uses double precision and no random numbers, so equal calls give equal bits in every process.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from smsl_studio.errors import WorldError
from smsl_studio.world.protocol import Quaternion, Vector
from smsl_studio.world.urdf import Joint

Array = NDArray[np.float64]


def rotation_of_rpy(rpy: Vector) -> Array:
    """Return the rotation matrix (3, 3) of roll, pitch, yaw (radians) about fixed axes, as in
    URDF."""
    (cr, cp, cy), (sr, sp, sy) = np.cos(rpy), np.sin(rpy)
    return np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )


def rotation_of(quaternion: Quaternion) -> Array:
    """Return the rotation matrix (3, 3) of a unit quaternion (x, y, z, w)."""
    x, y, z, w = quaternion
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


class Arm:
    """A chain of joints from the base to the tool.

    ``rest`` has the joint angles (radians) that a redundant arm prefers. So the solution for a pose
    hardly depends on the posture before it. WorldError if ``rest`` has not one angle for each
    moving joint. A joint turns or slides. ``base`` is where the base stands (m).
    """

    def __init__(
        self, chain: Sequence[Joint], rest: Sequence[float], base: Vector = (0.0, 0.0, 0.0)
    ) -> None:
        moving = [joint for joint in chain if joint.kind != "fixed"]
        if len(moving) != len(rest):
            raise WorldError(f"the arm has {len(moving)} joints, but its rest posture {len(rest)}")
        self.names = tuple(joint.name for joint in moving)
        self.rest: Array = np.array(rest, dtype=np.float64)
        self._lower = np.array([joint.lower for joint in moving])
        self._upper = np.array([joint.upper for joint in moving])
        self._steps = [(_frame(j), np.array(j.axis), j.kind, _turner(j.axis)) for j in chain]
        self._base: Array = np.array(base, dtype=np.float64)
        self._slides = np.array([joint.kind == "prismatic" for joint in moving])

    def tool(self, joints: Array) -> tuple[Array, Array]:
        """Return position (m) and rotation matrix (3, 3) of the tool in the frame of the world, for
        joint angles in radians (ways in metres)."""
        position, rotation, _ = self._forward(joints)
        return position, rotation

    def solve(self, position: Array, rotation: Array, near: Array) -> Array:
        """Return the joint angles (rad) that bring the tool to a pose. The search starts at
        ``near``.

        The result is accurate to 0.01 mm and 0.0001 rad. WorldError if the arm does not reach the
        pose.
        """
        joints = near.copy()
        for _ in range(80):
            here, turned, jacobian = self._forward(joints)
            error = np.concatenate([position - here, _turn(turned, rotation)])
            if np.abs(error[:3]).max() < 1e-5 and np.abs(error[3:]).max() < 1e-4:
                return joints
            joints = np.clip(joints + self._correction(jacobian, error, joints), *self._limits)
        raise WorldError(f"the arm does not reach {np.round(position, 3).tolist()} (metres)")

    @property
    def _limits(self) -> tuple[Array, Array]:
        return self._lower, self._upper

    def _correction(self, jacobian: Array, error: Array, joints: Array) -> Array:
        """Return the next change of the joints (rad): damped least squares for the tool, and the
        remaining freedom towards the rest posture."""
        square = jacobian @ jacobian.T + 1e-6 * np.eye(6)
        lean = 0.2 * (self.rest - joints)
        step = jacobian.T @ np.linalg.solve(square, error - jacobian @ lean) + lean
        return step * min(1.0, 0.5 / max(float(np.abs(step).max()), 1e-9))

    def _forward(self, joints: Array) -> tuple[Array, Array, Array]:
        rotation, position = np.eye(3), self._base
        axes, points, angle = [], [], iter(joints)
        for (offset, turn), axis, kind, about in self._steps:
            position = position + rotation @ offset
            rotation = rotation @ turn
            if kind != "fixed":
                axes.append(rotation @ axis)
                points.append(position)
                if kind == "prismatic":
                    position = position + axes[-1] * float(next(angle))
                else:
                    rotation = rotation @ about(float(next(angle)))
        z = np.array(axes)
        linear = _cross(z, position - np.array(points))
        if self._slides.any():
            linear[self._slides], z[self._slides] = z[self._slides], 0.0
        return position, rotation, np.concatenate([linear, z], axis=1).T


def _frame(joint: Joint) -> tuple[Array, Array]:
    return np.array(joint.xyz), rotation_of_rpy(joint.rpy)


def _turner(axis: Sequence[float]) -> Callable[[float], Array]:
    """Return the function that gives the rotation matrix for an angle (rad) about a unit axis
    (Rodrigues' formula)."""
    x, y, z = np.array(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    straight, square = np.eye(3), cross @ cross

    def turned(angle: float) -> Array:
        """Return the rotation matrix (3, 3)."""
        found: Array = straight + np.sin(angle) * cross + (1 - np.cos(angle)) * square
        return found

    return turned


def _cross(left: Array, right: Array) -> Array:
    """Return the cross product of each row (n, 3). ``numpy.cross`` gives the same and takes seven
    times as long for the few rows of an arm."""
    found = np.empty_like(right)
    for at, (one, other) in enumerate(((1, 2), (2, 0), (0, 1))):
        found[:, at] = left[:, one] * right[:, other] - left[:, other] * right[:, one]
    return found


def _turn(here: Array, there: Array) -> Array:
    """Return the rotation vector (radians) that turns ``here`` into ``there``, for small angles."""
    total = np.zeros(3)
    for product in _cross(here.T, there.T):
        total += product
    return 0.5 * total
