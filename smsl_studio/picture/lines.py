"""The drawing of an operation as SVG: its line, its arrowhead and its label."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from smsl_studio.legible import markup
from smsl_studio.picture.arrowhead import HEAD, arrowhead
from smsl_studio.picture.bundle_svg import draw_bundle, draw_count
from smsl_studio.picture.colours import Colours
from smsl_studio.picture.figure import LABEL, MARK, Figure
from smsl_studio.picture.guards import needs_words
from smsl_studio.picture.hidden_names import HiddenNames, hidden_names
from smsl_studio.picture.labels import FOOT, AsideRect, leader
from smsl_studio.picture.levels import Level
from smsl_studio.picture.shape import Point
from smsl_studio.picture.signs import DASHES, inks, sign_at
from smsl_studio.picture.strokes import arch, box, circle, number, polygon, polyline, text
from smsl_studio.stop import heed

MOST_PIECES = 4_000
"""The largest number of lines in one path. Qt draws only the beginning of a path of more than
32,767 points.
"""
NO_SIGNS: Mapping[int, str] = {}


def draw_lines(
    figure: Figure, edges: Sequence[int], colours: Colours, signs: Mapping[int, str] = NO_SIGNS
) -> Iterator[str]:
    """Yield the lines of these operations. If states are dots, the lines with the same sign are
    paths between centres.
    """
    if figure.shows_nodes:
        hidden, bundles = figure.picture.bundles.hidden, figure.picture.bundles.members
        # Lines with a sign lie on top of the others.
        for edge in sorted(edges, key=lambda one: one in signs):
            if edge in bundles:
                yield from draw_bundle(figure, edge, colours)
            elif edge not in hidden:
                yield from _line(figure, edge, colours, signs.get(edge, ""))
        return
    for sign in ("", *dict.fromkeys(signs.values())):
        chosen = [e for e in edges if signs.get(e, "") == sign]
        yield from _straight(figure, chosen, colours, sign)


def draw_labels(
    figure: Figure, edges: Sequence[int], colours: Colours, signs: Mapping[int, str] = NO_SIGNS
) -> Iterator[str]:
    """Yield the labels of these operations that have a place."""
    if not figure.shows_labels:
        return
    bundles = figure.picture.bundles
    for edge in edges:
        if edge in bundles.members:
            yield from draw_count(figure, edge, colours)
    places = {e: figure.geometry.label(e) for e in edges if e not in bundles.first}
    # Without room, a mark lies below the names.
    for names in hidden_names(figure.geometry, places):
        yield from _hidden(figure, names, colours)
    # All grounds lie below all labels, because labels of neighbouring lines may overlap.
    for left, top, right, bottom in filter(None, places.values()):
        yield box((left + 1.0, top, right - left - 2.0, bottom - top), 3.0, colours["canvas"])
    for edge, place in places.items():
        if isinstance(place, AsideRect):
            joined = leader(figure.geometry.shape(edge), place)
            yield polyline(joined, colours["edge"], 0.8, "2 2")
            yield circle(joined[0], FOOT, colours["edge"])
    for edge, place in places.items():
        if place is not None:
            yield from _label(figure, edge, place, colours, signs.get(edge, ""))


def _line(figure: Figure, edge: int, colours: Colours, sign: str) -> Iterator[str]:
    heed()
    shape = figure.geometry.shape(edge)
    colour = inks(sign, colours).line if sign else colours["edge"]
    wide = 2.2 if sign else 1.5 if figure.level is Level.FULL else 1.2
    head = HEAD + (1.0 if sign else 0.0) - (0.0 if figure.level is Level.FULL else 1.0)
    name, needs = figure.picture.operations[edge], needs_words(figure.picture.guards(edge))
    yield f"<g><title>{markup(f'{name} {needs}' if needs else name)}</title>"
    body = shape.cut(0.0, max(shape.length - head + 2.0, 0.0))
    yield polyline(body, colour, wide, DASHES.get(sign, ""))
    yield polygon(arrowhead(shape, head), colour)
    yield "</g>"


def _straight(figure: Figure, edges: list[int], colours: Colours, sign: str) -> Iterator[str]:
    picture, at, drawn = figure.picture, figure.at, figure.lines
    pieces = []
    for edge in edges:
        a, b = int(picture.source[edge]), int(picture.target[edge])
        bends = drawn[edge].bends if edge in drawn else ()
        if b >= 0 and (a != b or bends):
            corners = (at[a].tolist(), *bends, at[b].tolist())
            pieces.append("M" + "L".join(f"{number(x)} {number(y)}" for x, y in corners))
    colour = inks(sign, colours).line if sign else colours["edge"]
    wide = "2.4" if sign else "0.8"
    for first in range(0, len(pieces), MOST_PIECES):
        d = "".join(pieces[first : first + MOST_PIECES])
        yield f'<path d="{d}" fill="none" stroke="{colour}" stroke-width="{wide}"/>'


def _label(
    figure: Figure,
    edge: int,
    place: tuple[float, float, float, float],
    colours: Colours,
    sign: str,
) -> Iterator[str]:
    left, top, right, bottom = place
    middle = (top + bottom) / 2
    x = left + 4.0
    if sign:
        yield from sign_at((x + 5.0, middle), sign, colours, 5.5)
        x += MARK
    kind = figure.picture.kind(edge)
    if kind:
        yield from sub_mark_at((x + 4.5, middle), kind, colours)
        x += MARK
    needs = figure.picture.guards(edge)
    if needs:
        yield f"<g><title>{markup(needs_words(needs))}</title>"
        yield from guard_at((x + 4.5, middle), colours)
        yield "</g>"
        x += MARK
    colour = inks(sign, colours).line if sign else colours["tx2"]
    centre = (x + right - 4.0) / 2
    yield text((centre, middle + 3.9), figure.label(edge), LABEL, colour, 500)


def _hidden(figure: Figure, names: HiddenNames, colours: Colours) -> Iterator[str]:
    """Yield the mark in place of names without room, with the names in its title."""
    if not names.radius:
        return
    x, y = names.at
    yield f"<g><title>{markup(', '.join(map(figure.label, names.edges)))}</title>"
    yield circle(names.at, names.radius, colours["canvas"], colours["edge"])
    if names.large:
        yield text((x, y + 3.4), names.words, 9.5, colours["tx2"], 600)
    yield "</g>"


def sub_mark_at(at: Point, kind: str, colours: Colours) -> Iterator[str]:
    """Yield the mark of a rise, a fall or a mixed change, 9 pixels wide."""
    x, y = at
    ink = colours["acc"]
    if kind == "mixed":
        r = 4.4
        yield polygon([(x, y - r), (x + r, y), (x, y + r), (x - r, y)], colours["canvas"], ink)
        yield polygon([(x, y - r), (x + r, y), (x - r, y)], ink)
        return
    up = -1.0 if kind == "rise" else 1.0
    yield polygon([(x, y + 4 * up), (x + 4.2, y - 3.6 * up), (x - 4.2, y - 3.6 * up)], ink)


def guard_at(at: Point, colours: Colours) -> Iterator[str]:
    """Yield a lock, 9 pixels wide: the operation needs other facts first."""
    x, y = at
    yield arch((x, y - 0.8), 2.4, 3.4, colours["tx2"], 1.3)
    yield box((x - 4.0, y - 0.8, 8.0, 5.6), 1.4, colours["tx2"])
