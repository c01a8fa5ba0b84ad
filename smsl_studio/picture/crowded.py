"""Which drawings have so many operations that they should be collapsed."""

from __future__ import annotations

from smsl_studio.picture.crowd import MOST_LED
from smsl_studio.picture.geometry import Geometry
from smsl_studio.picture.labels import AsideRect
from smsl_studio.picture.picture import Picture

CROWDED = 40
"""With fewer operations than this every line can be followed."""


def may_be_crowded(picture: Picture) -> bool:
    """Return whether it is worth looking for names without room. In a very large picture nobody
    reads names, so it is not collapsed by itself.
    """
    return CROWDED <= len(picture.operations) <= MOST_LED and bool(picture.all_bundles.members)


def is_crowded(geometry: Geometry) -> bool:
    """Return whether a name has no room, or more than one in ten stand away from their lines.
    ``geometry`` is that of full nodes, with a line for each operation.
    """
    edges = range(len(geometry.picture.operations))
    geometry.prepare(edges)
    away = sum(isinstance(geometry.label(edge), AsideRect) for edge in edges)
    return 10 * away > len(edges) or any(map(geometry.is_hidden, edges))
