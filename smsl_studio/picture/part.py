"""PicturePart: the states and operations of an SB that are drawn or written, if not all are."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from smsl_studio.blueprint.address import Address
from smsl_studio.picture.figure import Figure, Rect
from smsl_studio.picture.picture import Picture


@dataclass(frozen=True)
class PicturePart:
    """Some states and operations of a picture, by number and in written order."""

    picture: Picture
    states: tuple[int, ...]
    edges: tuple[int, ...]


def whole_part(picture: Picture) -> PicturePart:
    """Return the part that has everything."""
    return PicturePart(picture, tuple(range(len(picture))), tuple(range(len(picture.operations))))


def chosen_part(picture: Picture, chosen: Iterable[Address]) -> PicturePart:
    """Return the part that a selection means.

    It has the chosen states with all operations between them, and the chosen operations with the
    states at their ends.
    """
    addresses = tuple(chosen)
    states = {at for one in addresses if (at := picture.node(one)) >= 0}
    edges = {edge for one in addresses if (edge := picture.edge(one)) >= 0}
    inside = np.zeros(len(picture) + 1, dtype=np.bool_)  # the last one stands for no target
    inside[list(states)] = True
    between = inside[picture.source] & inside[picture.target]
    for edge in edges:
        states |= {int(picture.source[edge]), int(picture.target[edge])} - {-1}
    edges |= set(np.nonzero(between)[0].tolist())
    return PicturePart(picture, tuple(sorted(states)), tuple(sorted(edges)))


def collapsed_part(picture: Picture, part: PicturePart) -> Picture:
    """Return the collapsed picture for a part of it.

    If only some operations of a bundle are in the part, each of them has its own line.
    """
    bundles, edges = picture.all_bundles, set(part.edges)
    return picture.collapse(
        [
            edge
            for edge in part.edges
            if edge in bundles.first and not edges.issuperset(bundles.members[bundles.first[edge]])
        ]
    )


def part_in(figure: Figure, frame: Rect) -> PicturePart:
    """Return the part of a figure of which something lies in a frame."""
    left, top, right, bottom = frame
    boxes = figure.boxes
    low, high = boxes[:, :2] - boxes[:, 2:], boxes[:, :2] + boxes[:, 2:]
    seen = (high >= (left, top)).all(axis=1) & (low <= (right, bottom)).all(axis=1)
    edges = (
        edge
        for edge in range(len(figure.picture.operations))
        if any(_meet(rect, frame) for rect in figure.rects_of(edge))
    )
    return PicturePart(figure.picture, tuple(np.nonzero(seen)[0].tolist()), tuple(edges))


def _meet(one: Rect, other: Rect) -> bool:
    """Whether two rectangles touch. A straight line up or across has one without an area."""
    return one[0] <= other[2] and other[0] <= one[2] and one[1] <= other[3] and other[1] <= one[3]
