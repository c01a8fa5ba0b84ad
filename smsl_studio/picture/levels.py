"""Levels of detail: how a node looks at a zoom, and how large one pixel of a mark is."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
FULL_SIZE, COMPACT_SIZE, BOX_SIZE, DOT_SIZE = (108.0, 54.0), (46.0, 24.0), (28.0, 16.0), (6.0, 6.0)
FULL_MAX, COMPACT_MAX = 200.0, 132.0
ROOM = (36.0, 24.0)
"""The room between full nodes, across and down (pixels), that an arrow needs."""
MANY = 5_000
"""Up to so many nodes, each is compared with the next 12 in its row and column. Of more nodes, each
is compared with the next 3."""


class Level(IntEnum):
    """How much a node shows, in order of detail."""

    DOT = 0
    BOX = 1
    COMPACT = 2
    FULL = 3


@dataclass(frozen=True)
class Spacing:
    """The room between the nodes of a layout: the zooms from which compact nodes and boxes do not
    overlap.

    ``roomy`` means that full nodes have room at 100 %. ``pitch`` is the usual distance between
    neighbours (scene units).
    """

    roomy: bool = True
    compact_zoom: float = 0.0
    box_zoom: float = 0.0
    pitch: float = 200.0


def level_at(zoom: float, spacing: Spacing) -> Level:
    """Return the level at a zoom. It is coarser if the layout is too dense.

    A layout without room for full nodes stays compact at high zoom. From 100 % on, compact nodes
    grow with the picture, so a coarser level would not help.
    """
    if spacing.roomy and zoom >= 0.70 - 1e-9:
        return Level.FULL
    if zoom >= 1.0 or (zoom >= 0.35 and zoom >= spacing.compact_zoom):
        return Level.COMPACT
    return Level.BOX if zoom >= 0.15 and zoom >= spacing.box_zoom else Level.DOT


def readable_zoom(spacing: Spacing) -> float:
    """Return the zoom from which states can be told apart. Boxes and dots all look the same."""
    near = 0.70 if spacing.roomy else 1.0
    return min(max(0.35, spacing.compact_zoom), near)


def unit_at(zoom: float, level: Level) -> float:
    """Return the number of scene units in one pixel of a mark.

    Full nodes are drawn in scene units. At other levels marks keep their size on the screen, but
    above 100 % they grow with the picture.
    """
    return 1.0 if level is Level.FULL or zoom >= 1.0 else 1.0 / zoom


def spacing_of(at: Floats, full: Floats, compact: Floats) -> Spacing:
    """Return the spacing of a layout, from the centres and the widths of full and compact nodes.

    A few nodes that are too near to others do not count, because somebody may have moved them. So
    one node among several others counts once, however many it is near to.
    """
    if len(at) < 2:
        return Spacing()
    a, b = _near_pairs(at)
    dx, dy = np.abs(at[a] - at[b]).T
    apart_full = (dx >= (full[a] + full[b]) / 2 + ROOM[0]) | (dy >= FULL_SIZE[1] + ROOM[1])
    near = np.concatenate((a[~apart_full], b[~apart_full]))
    others = np.concatenate((b[~apart_full], a[~apart_full]))
    moved = np.bincount(near, minlength=len(at)).argmax()
    crowded = np.zeros(len(at), dtype=bool)
    crowded[near[(near != moved) & (others != moved)]] = True
    crowded[moved] |= len(near) > 0
    nearest, apart = np.full(len(at), np.inf), np.hypot(dx, dy)
    np.minimum.at(nearest, a, apart)
    np.minimum.at(nearest, b, apart)
    widths = (compact[a] + compact[b]) / 2
    return Spacing(
        roomy=bool(crowded.mean() <= 0.25),
        compact_zoom=_zoom_apart(len(at), a, b, (widths + 8.0) / np.maximum(dx, 1e-6),
                                 (COMPACT_SIZE[1] + 8.0) / np.maximum(dy, 1e-6)),
        box_zoom=_zoom_apart(len(at), a, b, (BOX_SIZE[0] + 6.0) / np.maximum(dx, 1e-6),
                             (BOX_SIZE[1] + 6.0) / np.maximum(dy, 1e-6)),
        pitch=_median(nearest),
    )  # fmt: skip


def _zoom_apart(count: int, a: Ints, b: Ints, across: Floats, down: Floats) -> float:
    """Return the zoom from which three quarters of the nodes do not overlap any neighbour."""
    needed = np.zeros(count)
    each = np.minimum(across, down)
    np.maximum.at(needed, a, each)
    np.maximum.at(needed, b, each)
    return _quartile(needed)


def _median(values: Floats) -> float:
    """Return the same as ``np.median``, which would load numpy's masked arrays."""
    ordered = np.sort(values)
    return float(ordered[(len(ordered) - 1) // 2] + ordered[len(ordered) // 2]) / 2


def _quartile(values: Floats) -> float:
    """Return the value that three quarters of the values do not exceed, interpolated.

    It is the same as ``np.quantile``, which would load numpy's masked arrays.
    """
    at = 0.75 * (len(values) - 1)
    low = int(at)
    ordered = np.sort(values)
    a, b, share = float(ordered[low]), float(ordered[min(low + 1, len(values) - 1)]), at - low
    return b - (b - a) * (1.0 - share) if share >= 0.5 else a + (b - a) * share


def _near_pairs(at: Floats) -> tuple[Ints, Ints]:
    """Return pairs of neighbours, in order of rows and in order of columns."""
    first: list[Ints] = []
    second: list[Ints] = []
    rows = np.lexsort((at[:, 0], np.round(at[:, 1])))
    columns = np.lexsort((at[:, 1], np.round(at[:, 0])))
    for order in (rows, columns):
        for step in range(1, min(len(at), 13 if len(at) <= MANY else 4)):
            first.append(order[step:])
            second.append(order[:-step])
    return np.concatenate(first), np.concatenate(second)


def rest_mark(rest: int) -> str:
    """Return the text after the last fact of a node without room for all: the number of the
    others.
    """
    return f"+{rest}"
