"""The drawing of a state as SVG, with the marks of the canvas."""

from __future__ import annotations

from collections.abc import Iterator

from smsl_studio.legible import markup, one_line
from smsl_studio.picture.chip_words import CHIP_TEXT, GAP
from smsl_studio.picture.colours import Colours
from smsl_studio.picture.figure import (
    LABEL,
    LONGEST_LABEL,
    NAME,
    SHORT,
    Figure,
    chip_places,
)
from smsl_studio.picture.levels import Level, rest_mark
from smsl_studio.picture.node_rows import Rows, rows_of
from smsl_studio.picture.picture import Chip, Face
from smsl_studio.picture.shape import Point
from smsl_studio.picture.signs import DASHES, inks, sign_at
from smsl_studio.picture.strokes import box, circle, mono_text, number, polygon, polyline, text
from smsl_studio.picture.words import elided, mono_width


def draw_node(figure: Figure, state: int, colours: Colours, sign: str = "") -> Iterator[str]:
    """Yield one state. ``sign`` is ``+``, ``-``, ``~`` or empty."""
    x, y = map(float, figure.at[state])
    if not figure.shows_nodes:
        yield from _dot(figure, state, colours, sign)
        return
    face, wide, high = figure.faces[state], float(figure.widths[state]), figure.height
    radius = 8.0 if figure.level is Level.FULL else 6.0
    yield f'<g transform="translate({number(x)} {number(y)})">'
    title = f"{face.name}: {face.title}" if face.title else face.name
    yield f"<title>{markup(title)}</title>"
    ink = inks(sign, colours)
    rect = (-wide / 2, -high / 2, wide, high)
    yield box(rect, radius, ink.fill, ink.line, 2.2 if sign else 1.2, DASHES.get(sign, ""))
    if face.activating:
        gap = 3.5 if figure.level is Level.FULL else 2.8
        inner = (gap - wide / 2, gap - high / 2, wide - 2 * gap, high - 2 * gap)
        yield box(inner, radius - gap, "none", colours["slate"])
    if face.initial:
        yield from _initial((-wide / 2 - 3.0, figure.geometry.mark_shift), colours)
    yield from (
        _words(face, wide, colours) if figure.level is Level.FULL else _short(face, wide, colours)
    )
    if sign:
        yield from sign_at((wide / 2 - 2.0, -high / 2 + 2.0), sign, colours)
    yield "</g>"


def _dot(figure: Figure, state: int, colours: Colours, sign: str) -> Iterator[str]:
    """Yield a state of a large SB as a dot. INITIAL and ACTIVATING are larger, with their name
    above.
    """
    at = (float(figure.at[state, 0]), float(figure.at[state, 1]))
    ink = inks(sign, colours).line if sign else colours["slate"]
    if state not in figure.named:
        yield circle(at, 5.0 if sign else 3.0, ink)
        return
    name = figure.picture.names[state]
    if name == figure.picture.branch.activating:
        yield circle(at, 7.5, colours["surf"], ink)
    yield circle(at, 5.0, ink)
    shown = elided(name, NAME, LONGEST_LABEL)
    yield text((at[0], at[1] - 13.0), shown, NAME, colours["tx"], 600)


def _initial(tip: Point, colours: Colours) -> Iterator[str]:
    x, y = tip
    ink = colours["slate"]
    yield polyline([(x - 14.0, y), (x - 5.0, y)], ink, 1.4)
    yield circle((x - 17.0, y), 5.0, ink)
    yield polygon([(x, y), (x - 7.0, y - 3.6), (x - 7.0, y + 3.6)], ink)


def _short(face: Face, wide: float, colours: Colours) -> Iterator[str]:
    words = elided(face.short, SHORT, wide - 8.0)
    yield mono_text((0.0, 4.2), words, SHORT, colours["tx"], 500)


def _words(face: Face, wide: float, colours: Colours) -> Iterator[str]:
    rows = rows_of(face)
    name = elided(face.name, NAME, wide - 16.0)
    yield text((0.0, rows.name), name, NAME, colours["tx"], 600)
    if face.title:
        title = elided(one_line(face.title), LABEL, wide - 12.0)
        yield text((0.0, rows.title), title, LABEL, colours["tx2"])
    places = chip_places(face, wide)
    for chip, (left, across) in zip(face.chips, places, strict=False):
        yield from _chip(chip, left, across, rows, colours)
    if rest := len(face.chips) - len(places):
        mark = rest_mark(rest)
        half = mono_width(mark, CHIP_TEXT) / 2
        middle = places[-1][0] + places[-1][1] + GAP + half if places else 0.0
        y = rows.chips + rows.chip / 2 + 4.2
        yield mono_text((middle, y), mark, CHIP_TEXT, colours["tx2"], 500)


def _chip(chip: Chip, left: float, across: float, rows: Rows, colours: Colours) -> Iterator[str]:
    top, high = rows.chips, rows.chip
    if chip.kind == "on":
        yield box((left, top, across, high), 4.0, colours["slate"])
        ink = colours["onslate"]
    elif chip.kind == "off":
        edge = (left + 0.6, top + 0.6, across - 1.2, high - 1.2)
        yield box(edge, 4.0, colours["surf"], colours["line2"])
        ink = colours["tx2"]
    else:
        yield box((left, top, across, high), 4.0, colours["sunk"])
        ink = colours["tx"]
    middle = left + across / 2
    yield mono_text((middle, top + high / 2 + 4.2), chip.text, CHIP_TEXT, ink, 500)
    if chip.sub:
        yield box((middle - 6.5, top + high + 1.5, 13.0, 2.0), 1.0, colours["acc"])
