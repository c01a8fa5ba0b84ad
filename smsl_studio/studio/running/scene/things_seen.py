"""What the things of a scene cover of its picture, and which of them lies at a point."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSizeF

from smsl_studio.studio.running.scene.camera import Corner, WorldCamera, placed
from smsl_studio.world.protocol import Shape

Seen = tuple[Shape, QRectF]
"""A thing, and what it covers (pixels)."""


def things_seen(
    shapes: Sequence[Shape],
    corners: Sequence[Corner | None],
    poses: Sequence[float],
    camera: WorldCamera,
    size: QSizeF,
) -> Iterator[Seen]:
    """Yield the things with ``corners``, each with what it covers of a picture. What is below the
    ground is left out."""
    room = QRectF(0, 0, size.width(), size.height())
    for index, (shape, own) in enumerate(zip(shapes, corners, strict=True)):
        if own is None or len(poses) < 7 * index + 7:
            continue
        world = placed(own, poses[7 * index : 7 * index + 7])
        world[:, 2] = np.maximum(world[:, 2], 0.0)
        pixels = camera.pixels(world, size.width(), size.height())
        if pixels is None:
            continue
        (left, top), (right, bottom) = pixels.min(axis=0), pixels.max(axis=0)
        seen = QRectF(left, top, max(right - left, 1.0), max(bottom - top, 1.0))
        if seen.intersects(room):
            yield shape, seen


def thing_at(point: QPointF, seen: Iterable[Seen]) -> str:
    """Return the name of the thing at a point, the smallest of several; empty for none."""
    here = [
        (box.width() * box.height(), shape.name)
        for shape, box in seen
        if box.adjusted(-NEAR, -NEAR, NEAR, NEAR).contains(point)
    ]
    return min(here)[1] if here else ""


NEAR = 4.0
"""So far beside a thing a click still means it (pixels)."""
