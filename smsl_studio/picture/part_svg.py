"""A part of an SB as SVG, such as what is selected or in view, without title and legend."""

from __future__ import annotations

import numpy as np

from smsl_studio.picture.bundle_svg import draw_stubs
from smsl_studio.picture.colours import LIGHT, Colours
from smsl_studio.picture.drawn_svg import draw_groups, draw_notes, draw_titles
from smsl_studio.picture.figure import Figure, Rect
from smsl_studio.picture.lines import draw_labels, draw_lines
from smsl_studio.picture.nodes import draw_node
from smsl_studio.picture.part import PicturePart
from smsl_studio.picture.shape import Floats
from smsl_studio.picture.svg import GAP, framed


def draw_part(
    figure: Figure, part: PicturePart, title: str, colours: Colours = LIGHT, foot: str = ""
) -> str:
    """Return the SVG of a part. Lines and labels lie where the picture of the whole SB has them.

    ``foot`` is a line at the lower left corner.
    """
    left, top, right, bottom = figure.bounds(part.states, part.edges)
    frame = (left - GAP, top - GAP, right + GAP, bottom + GAP)
    drawn = figure.drawn_with(part.states)
    return framed(_parts(figure, part, drawn, colours), frame, title, colours, foot)


def draw_frame(
    figure: Figure,
    part: PicturePart,
    frame: Rect,
    title: str,
    colours: Colours = LIGHT,
    foot: str = "",
) -> str:
    """Return the SVG of a frame of a figure. What crosses its border is cut off there.

    ``foot`` is a line at the lower left corner.
    """
    drawn = _within(figure.note_rects, frame), _within(figure.group_rects, frame)
    return framed(_parts(figure, part, drawn, colours), frame, title, colours, foot)


def _within(rects: Floats, frame: Rect) -> list[int]:
    """Return the numbers of the rectangles that touch a frame."""
    low, high = rects[:, :2] <= frame[2:], rects[:, 2:] >= frame[:2]
    found: list[int] = np.nonzero((low & high).all(axis=1))[0].tolist()
    return found


def _parts(
    figure: Figure, part: PicturePart, drawn: tuple[list[int], list[int]], colours: Colours
) -> list[str]:
    """Return the pieces of SVG of a part. ``drawn`` has the numbers of its notes and groups."""
    notes, groups = drawn
    return [
        *draw_groups(figure, groups, colours),
        *draw_lines(figure, part.edges, colours),
        *draw_stubs(figure, part.states, colours),
        *draw_titles(figure, groups, colours),
        *draw_notes(figure, notes, colours),
        *(svg for state in part.states for svg in draw_node(figure, state, colours)),
        *draw_labels(figure, part.edges, colours),
    ]
