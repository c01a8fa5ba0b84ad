"""What can be read in a drawing besides names: no label may cover it."""

from __future__ import annotations

from collections.abc import Callable

from smsl_studio.picture.curves import LineStyle
from smsl_studio.picture.drawn_parts import DrawnParts
from smsl_studio.picture.picture import Picture
from smsl_studio.picture.returns import Rect, stub_rect
from smsl_studio.picture.shape import Floats, NodeBox


def readable_of(
    picture: Picture, boxes: Floats, style: LineStyle, box: Callable[[int], NodeBox]
) -> list[Rect]:
    """Return the rectangles of notes, of titles of groups, and of the marks of ways back to the
    start (scene units). ``box`` gives the box of a state.
    """
    drawn = DrawnParts(picture.branch, picture.index)
    found = drawn.readable(boxes, style.unit, style.scale)
    return [*found, *(stub_rect(box(state), style.unit) for state in picture.stubs)]


def stub_at(picture: Picture, state: int, box: NodeBox, unit: float) -> Rect | None:
    """Return the area of the mark for a state from which operations lead back through the lane."""
    return stub_rect(box, unit) if state in picture.stubs else None
