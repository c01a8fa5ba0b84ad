"""The phantom: a ball with landmarks on its analytic surface, on a stand (metres, kilograms).

A ray test of the engine is up to 1 mm off on a ball, so landmarks are points of the formula.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from smsl_studio.world.bodies import Body, Capsule
from smsl_studio.world.meshes import soup, turned

Array = NDArray[np.float64]

NAME = "phantom"
CENTRE: Array = np.array([0.57, 0.0, 0.15])
RADIUS = 0.08
COUNT = 5
"""The number of landmarks of a plan."""

LANDMARK, DOT = "landmark", 0.006
"""The name of the balls that show landmarks, before their number, and their radius (m)."""

STEEPEST = 0.48
"""The largest angle (rad) of a landmark's normal from the vertical; beyond it the arm would have to
fold more than it can."""

TARGETS: Array = np.array([[0.0, 0.0, 0.02], [0.02, 0.0, 0.03], [0.0, -0.02, 0.04]])
"""The places inside the ball (m, from its centre) at which the error of a registration is
measured."""


def phantom_body() -> Body:
    """Return the ball. It has no mass, so it stays where it is put."""
    ball = Capsule(RADIUS, 0.0001)
    mesh = turned(_outline(), 48)
    return Body(NAME, ball, _tuple(CENTRE), mesh=soup(mesh), colour=(0.86, 0.72, 0.62), label=NAME)


def landmark_bodies() -> list[Body]:
    """Return balls that show the planned landmarks. They are for the eye: the pointer touches the
    formula of the phantom, not them. Until there is a plan they are hidden in it."""
    angles = np.linspace(-math.pi / 2, math.pi / 2, 9)
    ball = soup(turned([(DOT * math.cos(a), DOT * math.sin(a)) for a in angles], 16))
    core = Capsule(0.0005, 0.0001)
    return [
        Body(f"{LANDMARK} {number + 1}", core, _tuple(CENTRE), mesh=ball, colour=(0.1, 0.25, 0.75))
        for number in range(COUNT)
    ]


def landmarks(seed: int, plan: int) -> Array:
    """Return the landmarks of the plan with this number, (COUNT, 3), in metres from the centre: one
    near the top, the others around it."""
    draw = np.random.default_rng([seed, plan])
    around = np.arange(COUNT - 1) * (2 * math.pi / (COUNT - 1)) + draw.uniform(-0.25, 0.25)
    angles = [0.08, *draw.uniform(0.8 * STEEPEST, STEEPEST, COUNT - 1)]
    turns = [draw.uniform(0, 2 * math.pi), *around]
    return np.array([RADIUS * normal(a, t) for a, t in zip(angles, turns, strict=True)])


def normal(angle: float, turn: float) -> Array:
    """Return the normal of the ball at an angle (rad) from the vertical, turned about it."""
    side = math.sin(angle)
    return np.array([side * math.cos(turn), side * math.sin(turn), math.cos(angle)])


def _outline() -> list[tuple[float, float]]:
    """The outline of the ball and its stand, (radius, height) from the centre of the ball."""
    foot = -float(CENTRE[2])
    stand = [(0.0, foot), (0.06, foot), (0.06, foot + 0.012), (0.022, foot + 0.02)]
    lowest = -math.acos(0.022 / RADIUS)
    arc = [lowest + (math.pi / 2 - lowest) * share / 18 for share in range(19)]
    ball = [(max(RADIUS * math.cos(a), 0.0), RADIUS * math.sin(a)) for a in arc]
    return [*stand, *ball[:-1], (0.0, RADIUS)]


def _tuple(point: Array) -> tuple[float, float, float]:
    x, y, z = point.tolist()
    return (x, y, z)
