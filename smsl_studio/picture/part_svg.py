"""A part of an SB as SVG, such as what is selected or in view, without title and legend."""

from __future__ import annotations

from smsl_studio.picture.colours import LIGHT, Colours
from smsl_studio.picture.figure import Figure, Rect
from smsl_studio.picture.lines import draw_labels, draw_lines
from smsl_studio.picture.nodes import draw_node
from smsl_studio.picture.part import PicturePart
from smsl_studio.picture.svg import GAP, framed


def draw_part(figure: Figure, part: PicturePart, title: str, colours: Colours = LIGHT) -> str:
    """Return the SVG of a part. Lines and labels lie where the picture of the whole SB has them."""
    left, top, right, bottom = figure.bounds(part.states, part.edges)
    return draw_frame(
        figure, part, (left - GAP, top - GAP, right + GAP, bottom + GAP), title, colours
    )


def draw_frame(
    figure: Figure, part: PicturePart, frame: Rect, title: str, colours: Colours = LIGHT
) -> str:
    """Return the SVG of a frame of a figure. What crosses its border is cut off there."""
    return framed(
        [
            *draw_lines(figure, part.edges, colours),
            *(svg for state in part.states for svg in draw_node(figure, state, colours)),
            *draw_labels(figure, part.edges, colours),
        ],
        frame,
        title,
        colours,
    )
