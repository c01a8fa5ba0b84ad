"""Bodies at rest: finds bodies that may touch each other, that are in one place, or still move."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from smsl_studio.errors import WorldError
from smsl_studio.world.protocol import Vector

Extent = tuple[Vector, Vector]
"""The box around a body: its smallest and its largest corner (m)."""

NEAR = 0.003
"""The largest distance (m) between the boxes of bodies that may touch each other."""


CALM = 0.002
"""The speed (m/s) below which a body counts as at rest."""

OVERLAP = 0.001
"""The depth (m) to which bodies may be in each other when a world is built."""

TOLD = 5
"""The largest number of moving bodies that a message names."""


def touching(extents: Mapping[str, Extent], one: Extent) -> set[str]:
    """Return the names of the bodies that may touch a body with the box ``one``."""
    return {name for name, other in extents.items() if _are_near(one, other)}


def restless(world: str, speeds: Mapping[str, float], limit: float) -> WorldError:
    """Return the error of a world that is not at rest after ``limit`` seconds. Speeds are in
    m/s."""
    # A speed of NaN does not count as at rest.
    moving = [f"{name} at {speed:.3g} m/s" for name, speed in speeds.items() if not speed < CALM]
    words = ", ".join(moving[:TOLD]) or "until just now something moved"
    more = f" and {len(moving) - TOLD} more" if len(moving) > TOLD else ""
    return WorldError(
        f"the world {world!r} does not come to rest within {limit:g} s: {words}{more}",
        advice="Put things where they can rest, or settle it with a longer limit.",
    )


def refuse_overlaps(world: str, contacts: Iterable[tuple[float, str, str]]) -> None:
    """Raise WorldError if two bodies are in one place. An engine would throw them apart.

    A contact is how deep (m) two bodies are in each other, and their names.
    """
    depth, one, other = max(contacts, default=(0.0, "", ""))
    if depth > OVERLAP:
        raise WorldError(
            f"{one!r} and {other!r} are in one place in the world {world!r}: they overlap by"
            f" {1000 * depth:.0f} mm",
            advice="Put them apart.",
        )


def _are_near(one: Extent, other: Extent) -> bool:
    return all(
        one[0][axis] - NEAR <= other[1][axis] and other[0][axis] - NEAR <= one[1][axis]
        for axis in range(3)
    )
