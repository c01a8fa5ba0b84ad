"""A physical world in PyBullet. Only this file imports PyBullet. Each world has its own client.

A world is a plan (``bodies``) and an engine that was built from it. Two new engines that are built
from one plan and set to one snapshot run on with equal bits. An engine that is only set back keeps
hidden contact caches and drifts by micrometres. So ``apply`` and ``fork`` always start a new
engine.
"""

from __future__ import annotations

import math
import tempfile
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np

from smsl_studio.errors import WorldError, did_you_mean
from smsl_studio.world.bodies import UPRIGHT, Body, Box, Capsule, Floor, Robot
from smsl_studio.world.kinematics import Arm
from smsl_studio.world.links import description, urdf_text
from smsl_studio.world.manipulator import Manipulator, Pose
from smsl_studio.world.planned_world import MODELS, PlannedWorld
from smsl_studio.world.pose import check_amounts, check_orientation, check_position
from smsl_studio.world.protocol import Quaternion, Vector
from smsl_studio.world.rest import Extent, touching
from smsl_studio.world.silence import silence

with silence():
    import pybullet
    from pybullet_utils.bullet_client import BulletClient

ROUNDS = 50
"""The usual number of rounds in which the engine solves the forces of one tick."""

STILL: Vector = (0.0, 0.0, 0.0)


class BulletWorld(PlannedWorld):
    """Rigid bodies and at most one robot, in ticks of 1/240 s."""

    def __init__(self, name: str = "bullet") -> None:
        super().__init__(name)
        self._poses: dict[str, Pose] = {}
        self._applied: tuple[list[float], bytes] | None = None
        self._start()

    # -- building ------------------------------------------------------------------------------

    def add(self, part: Body | Robot) -> None:
        """Add a body or the robot to the world. WorldError for a name that exists already, a second
        robot, or numbers that are not valid."""
        self._check(part)
        self._plan.append(part)
        self._carriers = None
        with silence():
            self._make(part)

    def rebuild(self) -> None:
        """Begin again with a new engine: time zero, and every part at its place in the plan."""
        self.close()
        self._start()
        with silence():
            for part in self._plan:
                self._make(part)

    def _start(self) -> None:
        self._ids: dict[str, int] = {}
        self._glue: dict[int, tuple[str, str]] = {}
        self._robot: Manipulator | None = None
        self._ticks = 0
        self._changed()
        with silence():
            engine = BulletClient(pybullet.DIRECT)
            engine.setGravity(0, 0, -9.81)
            engine.setTimeStep(self.tick)
            engine.setPhysicsEngineParameter(deterministicOverlappingPairs=1)
        self._engine: Any = engine

    def _make(self, part: Body | Robot) -> None:
        if isinstance(part, Robot):
            self._robot = self._made(part)
            return
        made = self._engine.createMultiBody(part.mass, self._collision(part), -1, part.position)
        self._ids[part.name] = made
        self._engine.changeDynamics(made, -1, lateralFriction=part.friction)
        if part.mass:
            self._let_sleep(made, at_once=False)

    def _made(self, robot: Robot) -> Manipulator:
        urdf = description(robot, MODELS)
        if self._arm is None:
            self._arm = Arm(urdf.chain(robot.tool, robot.point), robot.rest, robot.base)
        if robot.size < 1.0:
            # Between fingers a light thing needs more rounds until their forces agree.
            rounds = round(ROUNDS / math.sqrt(robot.size))
            self._engine.setPhysicsEngineParameter(numSolverIterations=rounds)
        if not robot.links:
            return Manipulator(self._engine, robot, MODELS / robot.urdf, urdf, self._arm)
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "robot.urdf"
            file.write_text(urdf_text(robot, MODELS), encoding="utf-8")
            return Manipulator(self._engine, robot, file, urdf, self._arm)

    def _let_sleep(self, body: int, *, at_once: bool) -> None:
        """Allow a body to sleep: it costs no time while it rests, and a contact wakes it."""
        state = pybullet.ACTIVATION_STATE_ENABLE_SLEEPING
        if at_once:
            state |= pybullet.ACTIVATION_STATE_SLEEP
        self._engine.changeDynamics(body, -1, activationState=state)

    def _collision(self, body: Body) -> int:
        shape, make = body.collision, self._engine.createCollisionShape
        if isinstance(shape, Capsule):
            return int(make(pybullet.GEOM_CAPSULE, radius=shape.radius, height=shape.length))
        if isinstance(shape, Box):
            return int(make(pybullet.GEOM_BOX, halfExtents=shape.half))
        if isinstance(shape, Floor):
            return int(make(pybullet.GEOM_PLANE))
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "hulls.obj"
            file.write_text(shape.obj, encoding="ascii")
            return int(make(pybullet.GEOM_MESH, fileName=str(file)))

    # -- moving --------------------------------------------------------------------------------

    @property
    def robot(self) -> Manipulator:
        """The robot's motors and sensors. WorldError in a world without a robot."""
        if self._robot is None:
            raise self._no_robot()
        return self._robot

    def step(self) -> None:
        """Advance the world by one tick of 1/240 s."""
        self._engine.stepSimulation()
        self._ticks += 1
        self._changed()

    def _changed(self) -> None:
        self._poses = {}
        self.revision += 1

    def place(self, name: str, position: Vector, orientation: Quaternion = UPRIGHT) -> None:
        """Put a body at a position (m) and orientation, without speed.

        The body wakes, and so do all bodies that touched it before or touch it now. WorldError for
        an unknown name or a pose that is not valid.
        """
        check_position(name, position)
        check_orientation(name, orientation)
        woken = self._neighbours(name)
        self._put(name, position, orientation, STILL, STILL)
        for other in sorted(woken | self._neighbours(name)):
            self._wake(other)

    def _neighbours(self, name: str) -> set[str]:
        """Return the movable bodies that touch a body, and the body itself if it is movable.

        The engine itself then wakes all bodies that touch these or are glued to them.
        """
        extents = {other: self._extent(other) for other in self._loose()}
        return touching(extents, self._extent(name))

    def _extent(self, name: str) -> Extent:
        least, greatest = self._engine.getAABB(self._id(name))
        return least, greatest

    def _wake(self, name: str) -> None:
        state = pybullet.ACTIVATION_STATE_WAKE_UP
        self._engine.changeDynamics(self._id(name), -1, activationState=state)

    def _put(
        self, name: str, position: Vector, orientation: Quaternion, speed: Vector, spin: Vector
    ) -> None:
        self._engine.resetBasePositionAndOrientation(self._ids[name], position, orientation)
        self._engine.resetBaseVelocity(self._ids[name], speed, spin)
        self._changed()

    def settle(self, limit: float = 1.0) -> None:
        """Let all bodies fall to rest and sleep. It is a part of building and takes no simulated
        time.

        WorldError if two bodies are in one place, or if a body still moves after ``limit`` seconds.
        """
        before = self._ticks
        try:
            self._come_to_rest(limit)
            for name in self._loose():
                self._put(name, *self.pose(name), STILL, STILL)
                self._let_sleep(self._ids[name], at_once=True)
            self.step()  # for the engine a body sleeps only from the next tick on
        finally:
            self._ticks = before

    def _contacts(self) -> Iterator[tuple[float, str, str]]:
        names = {made: name for name, made in self._ids.items()}
        for contact in self._engine.getContactPoints():
            if contact[1] in names and contact[2] in names:
                one, other = sorted((names[contact[1]], names[contact[2]]))
                yield -contact[8], one, other

    def rub(self, name: str, friction: float) -> None:
        """Change the friction of a body until the world is built again. WorldError below 0."""
        check_amounts(name, "friction", [friction], least=0.0)
        self._engine.changeDynamics(self._id(name), -1, lateralFriction=friction)

    def stick(self, one: str, other: str) -> int:
        """Glue two bodies together in their present poses. Return the number for ``unstick``."""
        origin = (0.0, 0.0, 0.0)
        back = self._engine.invertTransform(*self.pose(one))
        offset, turned = self._engine.multiplyTransforms(*back, *self.pose(other))
        bodies = self._id(one), -1, self._id(other), -1
        joint = pybullet.JOINT_FIXED, origin, offset, origin, turned
        glue = int(self._engine.createConstraint(*bodies, *joint))
        self._glue[glue] = (one, other)
        return glue

    def unstick(self, glue: int) -> None:
        """Remove glue by its number. Both bodies wake."""
        self._engine.removeConstraint(glue)
        for name in self._glue.pop(glue, ()):
            self._wake(name)

    # -- asking --------------------------------------------------------------------------------

    def pose(self, name: str) -> Pose:
        """Return position (m) and orientation of a body. WorldError for an unknown name."""
        found = self._poses.get(name)
        if found is None:
            found = self._engine.getBasePositionAndOrientation(self._id(name))
            self._poses[name] = found
        return found

    def speed(self, name: str) -> float:
        """Return the speed of a body (m/s). Its rotation counts as the speed at 3 cm from its
        centre."""
        linear, angular = self._engine.getBaseVelocity(self._id(name))
        return float(np.linalg.norm(linear) + 0.03 * np.linalg.norm(angular))

    def fingers_on(self, name: str) -> int:
        """Return the number of the robot's fingers that press on a body: 0, 1 or 2."""
        return self.robot.touching(self._id(name))

    def poses(self) -> tuple[float, ...]:
        """Return 7 numbers for each shape: position (m) and quaternion (x, y, z, w)."""
        if self._carriers is None:
            self.shapes()
        frames = {} if self._robot is None else self._robot.frames()
        found: list[float] = []
        for name in self._carriers or ():
            position, orientation = self.pose(name) if name in self._ids else frames[name]
            found += (*position, *orientation)
        return tuple(found)

    # -- coming back ---------------------------------------------------------------------------

    def snapshot(self) -> bytes:
        """Return the whole state for ``apply``: the bytes of a row of doubles."""
        state = self._state()
        if self._applied is not None and state == self._applied[0]:
            return self._applied[1]
        return np.array(state, dtype=np.float64).tobytes()

    def apply(self, snapshot: bytes) -> None:
        """Go back to a snapshot. WorldError if the snapshot is from a world with another plan."""
        if len(snapshot) != 8 * len(self._state()):
            raise WorldError(f"this snapshot is not of a world built like {self.name!r}")
        ticks, *values = np.frombuffer(snapshot, dtype=np.float64).tolist()
        check_amounts(self.name, "the numbers of a snapshot", [ticks, *values])
        self.rebuild()
        self._ticks = int(ticks)
        for name in self._loose():
            row, values = values[:13], values[13:]
            check_orientation(name, row[3:7])
            self._put(name, row[:3], row[3:7], row[7:10], row[10:])
        if self._robot is not None:
            self._robot.restore(values)
        # The engine normalises quaternions, which may change the last digit. The snapshot counts.
        self._applied = (self._state(), snapshot)

    def fork(self) -> BulletWorld:
        """Return another world with its own engine, in the same state."""
        other = BulletWorld(self.name)
        for part in self._plan:
            other.add(part)
        other.apply(self.snapshot())
        return other

    def _state(self) -> list[float]:
        """Return the state of all movable bodies and of the robot as plain numbers."""
        found = [float(self._ticks)]
        for name in self._loose():
            linear, angular = self._engine.getBaseVelocity(self._ids[name])
            found += [value for part in (*self.pose(name), linear, angular) for value in part]
        return found if self._robot is None else found + self._robot.state()

    def _id(self, name: str) -> int:
        found = self._ids.get(name)
        if found is None:
            near = did_you_mean(name, self._ids)
            raise WorldError(f"there is no body {name!r} in the world {self.name!r}", advice=near)
        return found

    def close(self) -> None:
        """Close the engine. A second call does nothing."""
        with silence(), suppress(pybullet.error):
            self._engine.disconnect()
