"""Whether a robot reaches the places of its work, asked before anything moves."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from smsl_studio.errors import WorldError
from smsl_studio.world.motions import DOWN
from smsl_studio.world.protocol import Vector

if TYPE_CHECKING:
    from smsl_studio.world.bullet import BulletWorld


def refuse_unreached(world: BulletWorld, robot: str, places: Iterable[tuple[str, Vector]]) -> None:
    """Raise WorldError if the robot, whose name is ``robot``, does not reach a place (m) with the
    hand down.

    Each place is first sought from the rest posture, then from the place before it.
    """
    near = world.arm.rest
    for name, place in places:
        for start in (world.arm.rest, near):
            try:
                near = world.arm.solve(np.array(place), DOWN, near=start)
                break
            except WorldError:
                continue
        else:
            where = ", ".join(f"{value:.3f}" for value in place)
            words = f"the robot {robot!r} does not reach {name} of the world {world.name!r}"
            raise WorldError(
                f"{words} ({where} m)",
                advice="Choose another robot, or stand it elsewhere (base).",
            )
