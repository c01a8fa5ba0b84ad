"""A physical world in MuJoCo (extra ``mujoco``). Only this file imports MuJoCo.

It is built from the same plan (``bodies``) as a world in PyBullet, and plugins use it in the same
way. The engine compiles a whole model at once, so that is done when it is first needed.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations
from typing import Any

import mujoco
import numpy as np

from smsl_studio.errors import WorldError, did_you_mean
from smsl_studio.world.bodies import UPRIGHT, Body, Box, Capsule, Floor, Robot
from smsl_studio.world.kinematics import Arm
from smsl_studio.world.manipulator import Pose
from smsl_studio.world.meshes import hulls_of
from smsl_studio.world.mujoco_arm import (
    DAMPING,
    FINGER_DAMPING,
    FINGER_STIFFNESS,
    STIFFNESS,
    MujocoArm,
)
from smsl_studio.world.planned_world import MODELS, PlannedWorld
from smsl_studio.world.pose import check_amounts, check_orientation, check_position
from smsl_studio.world.protocol import Quaternion, Vector
from smsl_studio.world.urdf import read_urdf

SUBSTEPS = 2
"""The steps of the engine in one tick."""

MARGIN = 0.001
"""The margin (m) of every convex piece: plans have pieces that are smaller by it, because PyBullet
adds it, too."""

INERTIA = 0.1
"""The inertia (kg m2) of each motor of an arm, as geared motors have it."""

STATE = mujoco.mjtState.mjSTATE_INTEGRATION


class MujocoWorld(PlannedWorld):
    """Rigid bodies and at most one robot, in ticks of 1/240 s."""

    def __init__(self, name: str = "mujoco") -> None:
        super().__init__(name)
        self._robot: MujocoArm | None = None
        self._model: Any = None
        self._data: Any = None

    # -- building ------------------------------------------------------------------------------

    def add(self, part: Body | Robot) -> None:
        """Add a body or the robot to the world. WorldError for a name that exists already, a second
        robot, or numbers that are not valid."""
        self._check(part)
        if isinstance(part, Robot):
            if part.links or not part.urdf:
                raise WorldError(
                    f"{part.name!r} has links of its own, which MuJoCo is not told yet",
                    advice="Use an arm that a URDF file describes whole, such as panda.",
                )
            chain = read_urdf(MODELS / part.urdf).chain(part.tool, part.point)
            self._arm = Arm(chain, part.rest)
        self._plan.append(part)
        self._carriers = None
        self.rebuild()

    def rebuild(self) -> None:
        """Begin again: time zero, and every part at its place in the plan."""
        self._model = self._data = self._robot = None
        self._ticks = 0
        self._changed()

    @property
    def model(self) -> Any:
        """The engine's model of all parts."""
        if self._model is None:
            self._compile()
        return self._model

    @property
    def data(self) -> Any:
        """The engine's state."""
        if self._data is None:
            self._compile()
        return self._data

    def _compile(self) -> None:
        robot = next((part for part in self._plan if isinstance(part, Robot)), None)
        spec = mujoco.MjSpec() if robot is None else _robot_spec(robot)
        spec.option.timestep = self.tick / SUBSTEPS
        spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
        spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
        spec.option.impratio = 10.0
        for part in self._plan:
            if isinstance(part, Body):
                _add_body(spec, part)
        for one, other in combinations(self._loose(), 2):
            glue = spec.add_equality(type=mujoco.mjtEq.mjEQ_WELD, name1=one, name2=other)
            glue.objtype, glue.active, glue.name = mujoco.mjtObj.mjOBJ_BODY, False, f"{one}|{other}"
        self._model = spec.compile()
        self._data = mujoco.MjData(self._model)
        if robot is not None and self._arm is not None:
            self._robot = MujocoArm(self, robot, self._arm)
        mujoco.mj_forward(self._model, self._data)

    # -- moving --------------------------------------------------------------------------------

    @property
    def robot(self) -> MujocoArm:
        """The robot's motors and sensors. WorldError in a world without a robot."""
        if self._model is None:
            self._compile()
        if self._robot is None:
            raise self._no_robot()
        return self._robot

    def step(self) -> None:
        """Advance the world by one tick of 1/240 s."""
        mujoco.mj_step(self.model, self.data, SUBSTEPS)
        self._ticks += 1
        self._changed()

    def _changed(self) -> None:
        self.revision += 1

    def place(self, name: str, position: Vector, orientation: Quaternion = UPRIGHT) -> None:
        """Put a body at a position (m) and orientation, without speed. WorldError for an unknown
        name or a pose that is not valid."""
        check_position(name, position)
        check_orientation(name, orientation)
        body, (x, y, z, w) = self._body(name), orientation
        if name in self._loose():
            joint = self.model.joint(name)
            self.data.qpos[joint.qposadr[0] :][:7] = (*position, w, x, y, z)
            self.data.qvel[joint.dofadr[0] :][:6] = 0.0
        else:
            self.model.body_pos[body], self.model.body_quat[body] = position, (w, x, y, z)
        mujoco.mj_forward(self.model, self.data)
        self._changed()

    def settle(self, limit: float = 1.0) -> None:
        """Let all bodies fall to rest. It is a part of building and takes no simulated time.

        WorldError if two bodies are in one place, or if a body still moves after ``limit`` seconds.
        """
        before = self._ticks
        try:
            self._come_to_rest(limit)
        finally:
            self._ticks = before

    def _contacts(self) -> Iterator[tuple[float, str, str]]:
        bodies = {part.name for part in self._plan if isinstance(part, Body)}
        for contact in self.data.contact:
            pair = (self.model.geom_bodyid[geom] for geom in (contact.geom1, contact.geom2))
            one, other = sorted(self.model.body(body).name for body in pair)
            if {one, other} <= bodies:
                yield -contact.dist, one, other

    def rub(self, name: str, friction: float) -> None:
        """Change the friction of a body until the world is built again. WorldError below 0."""
        check_amounts(name, "friction", [friction], least=0.0)
        geoms = self.geoms(self._body(name))
        self.model.geom_friction[geoms, 0] = friction
        # Of two things that touch, the rougher one would count in this engine.
        self.model.geom_priority[geoms] = 1

    def stick(self, one: str, other: str) -> int:
        """Glue two bodies together in their present poses. Return the number for ``unstick``."""
        first, second = sorted((one, other), key=self._loose().index)
        glue = int(self.model.equality(f"{first}|{second}").id)
        (at, turn), (to, turned) = (self._frame(name) for name in (first, second))
        back, place, between = np.zeros(4), np.zeros(3), np.zeros(4)
        mujoco.mju_negQuat(back, turn)
        mujoco.mju_rotVecQuat(place, to - at, back)
        mujoco.mju_mulQuat(between, back, turned)
        self.model.eq_data[glue, :10] = (0.0, 0.0, 0.0, *place, *between)
        self.data.eq_active[glue] = True
        return glue

    def unstick(self, glue: int) -> None:
        """Remove glue by its number."""
        self.data.eq_active[glue] = False

    def _frame(self, name: str) -> tuple[Any, Any]:
        body = self._body(name)
        return self.data.xpos[body].copy(), self.data.xquat[body].copy()

    # -- asking --------------------------------------------------------------------------------

    def pose(self, name: str) -> Pose:
        """Return position (m) and orientation of a body. WorldError for an unknown name."""
        body = self._body(name)
        x, y, z = self.data.xpos[body].tolist()
        qw, qx, qy, qz = self.data.xquat[body].tolist()
        return (x, y, z), (qx, qy, qz, qw)

    def speed(self, name: str) -> float:
        """Return the speed of a body (m/s). Its rotation counts as the speed at 3 cm from its
        centre."""
        first = int(self.model.joint(name).dofadr[0])
        linear, angular = np.split(self.data.qvel[first : first + 6], 2)
        return float(np.linalg.norm(linear) + 0.03 * np.linalg.norm(angular))

    def fingers_on(self, name: str) -> int:
        """Return the number of the robot's fingers that press on a body: 0, 1 or 2."""
        return self.robot.touching(set(self.geoms(self._body(name))))

    def presses(self, one: set[int], other: set[int]) -> bool:
        """Whether a shape of ``one`` presses on a shape of ``other``."""
        force = np.zeros(6)
        for number, (a, b) in enumerate(self.data.contact.geom.tolist()):
            if (a in one and b in other) or (b in one and a in other):
                mujoco.mj_contactForce(self.model, self.data, number, force)
                if force[0] > 0.0:
                    return True
        return False

    def geoms(self, body: int) -> list[int]:
        """Return the numbers of the shapes of a body, for contacts."""
        first = int(self.model.body_geomadr[body])
        return list(range(first, first + int(self.model.body_geomnum[body])))

    def _body(self, name: str) -> int:
        found = int(mujoco.mj_name2id(self.model, mujoco.mjtObj.mjOBJ_BODY, name))
        if found < 0:
            near = did_you_mean(name, [part.name for part in self._plan])
            raise WorldError(f"there is no body {name!r} in the world {self.name!r}", advice=near)
        return found

    def poses(self) -> tuple[float, ...]:
        """Return 7 numbers for each shape: position (m) and quaternion (x, y, z, w)."""
        if self._carriers is None:
            self.shapes()
        poses = (self.pose(name) for name in self._carriers or ())
        return tuple(value for place, turn in poses for value in (*place, *turn))

    # -- coming back ---------------------------------------------------------------------------

    def snapshot(self) -> bytes:
        """Return the whole state for ``apply``: the bytes of a row of doubles."""
        size = mujoco.mj_stateSize(self.model, STATE)
        state = np.zeros(size)
        mujoco.mj_getState(self.model, self.data, state, STATE)
        own = [] if self._arm is None else self.robot.state()
        return np.array([float(self._ticks), *own, *state.tolist()]).tobytes()

    def apply(self, snapshot: bytes) -> None:
        """Go back to a snapshot. WorldError if the snapshot is from a world with another plan."""
        if len(snapshot) != len(self.snapshot()):
            raise WorldError(f"this snapshot is not of a world built like {self.name!r}")
        ticks, *values = np.frombuffer(snapshot, dtype=np.float64).tolist()
        check_amounts(self.name, "the numbers of a snapshot", [ticks, *values])
        self.rebuild()
        if self._arm is not None:
            count = len(self.robot.state())
            self.robot.restore(values[:count])
            values = values[count:]
        mujoco.mj_setState(self.model, self.data, np.array(values), STATE)
        mujoco.mj_forward(self.model, self.data)
        # The solver begins where it ended, and ``mj_forward`` has moved that.
        mujoco.mj_setState(self.model, self.data, np.array(values), STATE)
        self._ticks = int(ticks)

    def fork(self) -> MujocoWorld:
        """Return another world with its own engine, in the same state."""
        other = MujocoWorld(self.name)
        for part in self._plan:
            other.add(part)
        other.apply(self.snapshot())
        return other

    def close(self) -> None:
        """Free the engine. A second call does nothing."""
        self._model = self._data = self._robot = None


def _robot_spec(robot: Robot) -> Any:
    """Return the engine's description of a robot, with a motor at each joint. Only its fingers
    touch anything."""
    path = MODELS / robot.urdf
    text = path.read_text("utf-8").replace("package://", "")
    begin = text.index(">", text.index("<robot")) + 1
    options = (
        f'<mujoco><compiler meshdir="{path.parent}" strippath="false" discardvisual="true"'
        ' fusestatic="false" balanceinertia="true"/></mujoco>'
    )
    spec = mujoco.MjSpec.from_string(text[:begin] + options + text[begin:])
    for body in spec.bodies[1:]:
        body.gravcomp = 1.0
    for joint in spec.joints:
        is_finger = joint.name in robot.fingers
        joint.armature = INERTIA
        for geom in joint.parent.geoms:
            geom.contype, geom.conaffinity = (2, 1) if is_finger else (0, 0)
            geom.friction[0], geom.condim = robot.friction, 4
        _add_motor(spec, joint.name, robot.force if is_finger else 0.0)
    for geom in spec.geoms:
        if geom.contype == 1:
            geom.contype, geom.conaffinity = 0, 0
    if robot.fingers:
        gear = spec.add_equality(type=mujoco.mjtEq.mjEQ_JOINT, name="gear")
        gear.name1, gear.name2 = robot.fingers
        gear.objtype = mujoco.mjtObj.mjOBJ_JOINT
        gear.data[:5] = (0.0, 1.0, 0.0, 0.0, 0.0)
    return spec


def _add_motor(spec: Any, joint: str, force: float) -> None:
    """Add a motor that holds a place with stiffness and damping. That of a finger has a ``force``
    (N), which is its limit."""
    stiff, damp = (FINGER_STIFFNESS, FINGER_DAMPING) if force else (STIFFNESS, DAMPING)
    motor = spec.add_actuator(name=joint, target=joint)
    motor.trntype = mujoco.mjtTrn.mjTRN_JOINT
    motor.gaintype, motor.biastype = mujoco.mjtGain.mjGAIN_FIXED, mujoco.mjtBias.mjBIAS_AFFINE
    motor.gainprm[0] = stiff
    motor.biasprm[1], motor.biasprm[2] = -stiff, -damp
    motor.forcelimited, motor.forcerange = bool(force), (-force, force)


def _add_body(spec: Any, part: Body) -> None:
    body = spec.worldbody.add_body(name=part.name, pos=part.position)
    if part.mass:
        body.add_freejoint(name=part.name)
    shape, kinds = part.collision, mujoco.mjtGeom
    if isinstance(shape, Capsule):
        size = (shape.radius, shape.length / 2, 0.0)
        pieces = [body.add_geom(type=kinds.mjGEOM_CAPSULE, size=size)]
    elif isinstance(shape, Box):
        pieces = [body.add_geom(type=kinds.mjGEOM_BOX, size=shape.half)]
    elif isinstance(shape, Floor):
        pieces = [body.add_geom(type=kinds.mjGEOM_PLANE, size=(2.0, 2.0, 0.1))]
    else:
        pieces = []
        for number, corners in enumerate(hulls_of(shape.obj)):
            name = f"{part.name} {number}"
            spec.add_mesh(name=name, uservert=np.ravel(corners))
            pieces.append(body.add_geom(type=kinds.mjGEOM_MESH, meshname=name, margin=MARGIN))
    for piece in pieces:
        piece.friction[0], piece.condim = part.friction, 4
        piece.contype, piece.conaffinity = 1, 3
        if part.mass:
            piece.mass = part.mass / len(pieces)
