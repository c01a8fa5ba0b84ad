"""Picking a piece up and putting it down with a gripper, written once for all plugins.

Each ``yield`` is one tick of the world. A motion may be dropped at any ``yield``: a piece that is
in the fingers then stays there.
"""

from __future__ import annotations

import math
from collections.abc import Generator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from smsl_studio.world.motions import DOWN, Array, Motion, tool, travel, wait

if TYPE_CHECKING:
    from smsl_studio.world.bullet import BulletWorld

TRAVEL, CAREFUL = 0.6, 0.35
"""The greatest speeds (m/s): between places, and while a piece is lifted or lowered."""

YIELDS = 0.005
"""The distance (m) that a piece is pushed up in the fingers before it counts as blocked."""

CLOSING, OPENING = 36, 24
"""The number of ticks that the fingers take to close or to open."""


@dataclass(frozen=True, slots=True)
class Grasp:
    """How a piece is held. Lengths are in metres.

    ``half`` is half of its width between the fingers, ``high`` the height of the tool above its
    middle, ``clear`` the height of the tool on its way over everything. ``opening`` is the distance
    of each finger from the middle before they close, and ``turn`` the angle (rad) of the hand about
    the vertical, 0 with fingers that close along y.
    """

    half: float
    high: float
    clear: float
    opening: float = 0.04
    turn: float = 0.0

    @property
    def rotation(self) -> Array:
        """The rotation (3, 3) of the tool."""
        cosine, sine = math.cos(self.turn), math.sin(self.turn)
        turned = np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])
        found: Array = turned @ DOWN
        return found


def move(world: BulletWorld, name: str, grasp: Grasp, place: Array) -> Generator[None, None, bool]:
    """Pick a piece up and put its middle at ``place`` (m). Return False if that fails.

    A piece that is held already is not picked. If it meets an obstacle on its way down, it is
    raised again and stays in the hand.
    """
    if world.fingers_on(name) < 2:
        yield from _pick(world, name, grasp)
    if world.fingers_on(name) < 2:
        yield from _let_go(world)
        return False
    yield from travel(world, [_above(tool(world), grasp)], CAREFUL, _turned(world))
    if world.fingers_on(name) < 2:
        yield from _let_go(world)
        return False
    return (yield from _put(world, name, grasp, place))


def _pick(world: BulletWorld, name: str, grasp: Grasp) -> Motion:
    middle = _middle(world, name)
    hold = np.add(middle, (0.0, 0.0, grasp.high))
    world.robot.grip(grasp.opening)
    yield from travel(world, [_above(tool(world), grasp)], TRAVEL, _turned(world))
    yield from travel(world, [_above(middle, grasp)], TRAVEL, grasp.rotation)
    yield from travel(world, [hold], CAREFUL, grasp.rotation)
    world.robot.grip(grasp.half - 0.006)
    yield from wait(CLOSING)


def _put(world: BulletWorld, name: str, grasp: Grasp, place: Array) -> Generator[None, None, bool]:
    turned = _turned(world)
    shift = tool(world) - _middle(world, name)
    yield from travel(world, [_above(place + shift, grasp)], TRAVEL, turned)
    shift = tool(world) - _middle(world, name)
    # A millimetre above it, so that the piece is not pressed down.
    for _ in travel(world, [np.add(place, (0.0, 0.0, 0.001)) + shift], CAREFUL, turned):
        if world.fingers_on(name) < 2:
            yield from _let_go(world)
            return False
        if (shift - tool(world) + _middle(world, name))[2] > YIELDS:
            yield from travel(world, [_above(tool(world), grasp)], CAREFUL, turned)
            return False
        yield
    # Fingers that open wide would push what stands beside it.
    world.robot.grip(grasp.opening)
    yield from wait(OPENING)
    yield from travel(world, [_above(tool(world), grasp)], CAREFUL, turned)
    return True


def _let_go(world: BulletWorld) -> Motion:
    world.robot.open()
    yield from wait(OPENING)


def _middle(world: BulletWorld, name: str) -> Array:
    return np.array(world.pose(name)[0])


def _turned(world: BulletWorld) -> Array:
    """Return the commanded rotation of the tool: with a piece in the hand it is not turned."""
    found: Array = world.arm.tool(world.robot.goal)[1]
    return found


def _above(point: Array, grasp: Grasp) -> Array:
    return np.array([point[0], point[1], grasp.clear])
