"""A blueprint as SVG: all SBs in one picture, or one picture each."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import ceil

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.graph.layout import place_states
from smsl_studio.legible import markup
from smsl_studio.picture.colours import LIGHT, Colours
from smsl_studio.picture.crowd import crowd_of, refuse_too_many
from smsl_studio.picture.figure import Figure, Rect
from smsl_studio.picture.panel import SvgPanel, panel_of
from smsl_studio.picture.picture import Picture
from smsl_studio.picture.strokes import box, number, text
from smsl_studio.picture.words import FAMILY, elided, width

GAP = 20.0
SMALL = 10.0
"""The size of the line at the foot, in pixels."""


def draw_blueprint(
    blueprint: Blueprint,
    branches: Sequence[str],
    colours: Colours = LIGHT,
    collapsed: bool = False,
) -> list[SvgPanel]:
    """Return a panel for each SB, with the places of ``_layout`` or computed places. With
    ``collapsed`` operations between the same two states are one line. UsageError for too many SBs.
    """
    refuse_too_many(blueprint, branches, "Name those to draw with --sb.")
    crowd = crowd_of(blueprint, branches)
    pictures = (Picture(blueprint, name, crowd) for name in branches)
    return [_panel(one.collapse() if collapsed else one, colours) for one in pictures]


def _panel(picture: Picture, colours: Colours) -> SvgPanel:
    branch = picture.branch
    figure = Figure(picture, place_states(branch))
    words = size_words(len(branch.table), branch.edge_count)
    return panel_of(figure, branch.name, words, colours)


def size_words(states: int, operations: int) -> str:
    """Return the size in words, such as ``27 states, 78 operations``."""
    return (
        f"{states} state{'' if states == 1 else 's'}, "
        f"{operations} operation{'' if operations == 1 else 's'}"
    )


def one_below_another(panels: Sequence[SvgPanel], colours: Colours = LIGHT) -> SvgPanel:
    """Return all panels in one, below each other. Several panels get a ground each."""
    wide = max((panel.width for panel in panels), default=200.0)
    parts: list[str] = []
    y = 0.0
    for panel in panels:
        if len(panels) > 1:
            parts.append(box((0.6, y + 0.6, wide - 1.2, panel.height - 1.2), 8.0, colours["canvas"],
                             colours["line"]))  # fmt: skip
        parts.append(panel.at(0.0, y))
        y += panel.height + GAP
    return SvgPanel(wide, max(y - GAP, 20.0), "\n".join(parts))


def as_svg(panel: SvgPanel, title: str, colours: Colours = LIGHT, foot: str = "") -> str:
    """Return a panel as the text of an SVG file. ``foot`` stands in the margin below."""
    frame = 0.0, 0.0, panel.width + 2 * GAP, panel.height + 2 * GAP
    return framed([panel.at(GAP, GAP)], frame, title, colours, foot)


def framed(
    parts: Iterable[str], frame: Rect, title: str, colours: Colours = LIGHT, foot: str = ""
) -> str:
    """Return pieces of SVG as the text of an SVG file that shows a frame of them.

    Its width and height are multiples of four (see ``paper``). ``foot`` is a line at the lower left
    corner, on a ground of its own.
    """
    left, top, right, bottom = frame
    x, y = number(left), number(top)
    wide, high = (number(4.0 * ceil(side / 4)) for side in (right - left, bottom - top))
    at = f'x="{x}" y="{y}" ' if (x, y) != ("0", "0") else ""
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" role="img" '
            f'viewBox="{x} {y} {wide} {high}" width="{wide}" '
            f'height="{high}" font-family="{FAMILY}">',
            f"<title>{markup(title)}</title>",
            f'<rect {at}width="{wide}" height="{high}" fill="{colours["canvas"]}"/>',
            *parts,
            *_foot(foot, (left, top + 4.0 * ceil((bottom - top) / 4)), right - left, colours),
            "</svg>",
            "",
        ]
    )


def _foot(words: str, corner: tuple[float, float], wide: float, colours: Colours) -> list[str]:
    """Return the line at the lower left corner of a picture that is ``wide`` pixels wide."""
    said = elided(words, SMALL, wide - 16.0) if words else ""
    if not said:
        return []
    left, bottom = corner
    ground = (left + 4.0, bottom - 17.0, width(said, SMALL) + 8.0, 15.0)
    baseline = left + 8.0, bottom - 6.0
    return [
        box(ground, 3.0, colours["canvas"]),
        text(baseline, said, SMALL, colours["tx2"], 400, "start"),
    ]
