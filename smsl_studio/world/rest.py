"""Coming to rest: which bodies lie against each other, and which still move."""

from __future__ import annotations

from collections.abc import Mapping

from smsl_studio.errors import WorldError
from smsl_studio.world.protocol import Vector

Extent = tuple[Vector, Vector]
"""The box around a body: its least and its greatest corner (m)."""

NEAR = 0.003
"""Bodies whose boxes are this close (m) may touch each other."""


CALM = 0.002
"""A body that is slower than this (m/s) counts as being at rest."""

TOLD = 5
"""So many of the bodies that still move are named."""


def touching(extents: Mapping[str, Extent], one: Extent) -> set[str]:
    """The bodies that may touch what fills ``one``."""
    return {name for name, other in extents.items() if _are_near(one, other)}


def restless(world: str, speeds: Mapping[str, float], limit: float) -> WorldError:
    """The error of a world that is not at rest after ``limit`` seconds; speeds in m/s."""
    # A speed that is no number is none at rest either.
    moving = [f"{name} at {speed:.3g} m/s" for name, speed in speeds.items() if not speed < CALM]
    words = ", ".join(moving[:TOLD]) or "until just now something moved"
    more = f" and {len(moving) - TOLD} more" if len(moving) > TOLD else ""
    return WorldError(
        f"the world {world!r} does not come to rest within {limit:g} s: {words}{more}",
        advice="Put things where they can rest, or settle it with a longer limit.",
    )


def _are_near(one: Extent, other: Extent) -> bool:
    return all(
        one[0][axis] - NEAR <= other[1][axis] and other[0][axis] - NEAR <= one[1][axis]
        for axis in range(3)
    )
