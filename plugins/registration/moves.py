"""What the arm does: it touches landmarks with the pointer while the tracker watches."""

from __future__ import annotations

import math
from collections.abc import Generator, Iterable
from typing import TYPE_CHECKING

import numpy as np

from smsl_studio.world.motions import DOWN, Array, Motion, bend, swing, tool, travel, wait
from smsl_studio.world.stations import Station

from .phantom import CENTRE, RADIUS, STEEPEST, normal
from .tracker import SAMPLES

if TYPE_CHECKING:
    from smsl_studio.world.bodies import Robot

    from .site import Site

AWAY = 0.05
"""The distance (m) from the surface from which the pointer comes down straight."""

GENTLE = 0.05
"""The greatest speed (m/s) of the pointer near the phantom."""

CONTACT = 0.0001
"""The largest distance (m) of the tip from the surface that counts as a touch."""

BENT = 0.0006
"""The largest distance (m) of two measurements of one landmark with a straight pointer."""

ROLL = 1.5
"""The angle (rad) by which the pointer is rolled about itself to see whether it is straight."""

BETWEEN = 2
"""The number of ticks between two samples."""


TOUCHING = (
    "Op_DigitizeLandmarks",
    "DigitizeAllLandmarks",
    "Op_Redigitize",
    "RedigitizeOneLandmark",
    "ConfirmAllDigitized",
)
"""The operations that touch landmarks."""


def digitize(site: Site, numbers: Iterable[int]) -> Generator[None, None, bool]:
    """Touch landmarks and measure them. Return False if the pointer touches nothing there, if it
    is bent, or if the reference was pushed meanwhile."""
    touched = list(numbers)
    for number in touched:
        mark = site.marks()[number]
        outwards = (mark - CENTRE) / RADIUS
        turned = towards(outwards)
        yield from swing(site.world, mark + AWAY * outwards, turned)
        yield from travel(site.world, [mark], GENTLE, turned)
        touches = abs(float(np.linalg.norm(tool(site.world) - site.centre())) - RADIUS) < CONTACT
        if touches:
            stand = site.tracker.stand
            point = yield from measure(site)
            now = site.navigation
            # What was measured before somebody pushed the reference is of another frame.
            touches = not now.measured or site.is_where(now.stand)
            kept = now if touches else now.without_measures()
            site.navigation = kept.with_measure(number, point, stand)
            # The tip may be bent at any moment, so it is tried before and after.
            if number in (touched[0], touched[-1]) and not (yield from _is_straight(site, point)):
                site.navigation = site.navigation.without_measures()
                touches = False
        yield from travel(site.world, [mark + AWAY * outwards], GENTLE, turned)
        if not touches:
            return False
    yield from park(site)
    return True


def _is_straight(site: Site, point: Array) -> Generator[None, None, bool]:
    """Roll the pointer about itself and measure again. Return whether both measurements agree: a
    bent tip would be elsewhere."""
    world = site.world
    posture = world.robot.goal
    yield from bend(world, [*posture[:-1], posture[-1] + ROLL])
    other = yield from measure(site)
    yield from bend(world, posture)
    return float(np.linalg.norm(other - point)) < BENT


def measure(site: Site) -> Generator[None, None, Array]:
    """Average samples of the tip, in the frame of the reference. While the tracker sees nothing it
    waits."""
    samples: list[Array] = []
    while len(samples) < SAMPLES:
        yield from wait(BETWEEN)
        if not site.tracker.occluded:
            place, turned = site.world.arm.tool(site.world.robot.joints())
            samples.append(site.tracker.sample(place + turned @ site.bend))
    found: Array = np.mean(samples, axis=0)
    return found


def park(site: Site) -> Motion:
    """Move the arm above the phantom, with the pointer down."""
    yield from swing(site.world, np.add(CENTRE, (0.0, 0.0, RADIUS + 2 * AWAY)), DOWN)


def stations_of(_: Robot) -> dict[str, tuple[Station, ...]]:
    """Return where the tip is at the steepest landmarks that a plan may have, and before it comes
    down there, for the operations that touch them."""
    found = []
    for turn in range(8):
        outwards = normal(STEEPEST, turn * math.pi / 4)
        first, second, third = towards(outwards).tolist()
        for words, off in (("a landmark", 0.0), ("above a landmark", AWAY)):
            x, y, z = (CENTRE + (RADIUS + off) * outwards).tolist()
            found.append(Station(words, (x, y, z), (*first, *second, *third)))
    return dict.fromkeys(TOUCHING, tuple(found))


def towards(outwards: Array) -> Array:
    """Return the rotation (3, 3) of a tool that points against a unit vector, turned as little as
    possible from pointing down."""
    down = np.array([0.0, 0.0, -1.0])
    axis, cosine = np.cross(down, -outwards), float(down @ -outwards)
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    turned: Array = (np.eye(3) + cross + cross @ cross / (1 + cosine)) @ DOWN
    return turned
