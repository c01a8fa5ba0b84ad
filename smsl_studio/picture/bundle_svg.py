"""Bundles as SVG: a thick line for several operations, and the chip with their number."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from smsl_studio.legible import markup
from smsl_studio.picture.arrowhead import HEAD, arrowhead
from smsl_studio.picture.colours import Colours
from smsl_studio.picture.figure import Figure
from smsl_studio.picture.returns import CHIP_SIDES, HOUSE, TEXT, house, lane_words, stub_of
from smsl_studio.picture.strokes import box, polygon, polyline, text
from smsl_studio.stop import heed


def draw_bundle(figure: Figure, edge: int, colours: Colours) -> Iterator[str]:
    """Yield the line of the bundle with this first operation. It has a head at each end to which
    one of them leads. Its title names them all.
    """
    heed()
    picture, shape = figure.picture, figure.geometry.shape(edge)
    back = picture.leads_back(edge)
    colour, head = colours["edge"], HEAD + 1.0
    yield f"<g><title>{markup(_words(figure, edge))}</title>"
    first = head - 2.0 if back else 0.0
    body = shape.cut(first, max(shape.length - head + 2.0, first))
    yield polyline(body, colour, picture.bundles.width(edge))
    yield polygon(arrowhead(shape, head), colour)
    if back:
        yield polygon(arrowhead(shape.reversed, head), colour)
    yield "</g>"


def draw_count(figure: Figure, edge: int, colours: Colours) -> Iterator[str]:
    """Yield the chip of a bundle, in its place or in the middle of its line."""
    place = figure.geometry.label(edge) or figure.geometry.fallback(edge)
    bundles = figure.picture.bundles
    count, lane = bundles.count(edge), bundles.first[edge] == bundles.lane
    wide, high = figure.picture.chip_size(edge)
    x, y = (place[0] + place[2]) / 2, (place[1] + place[3]) / 2
    yield f"<g><title>{markup(_words(figure, edge))}</title>"
    area = (x - wide / 2, y - high / 2, wide, high)
    yield box(area, high / 2, colours["canvas"], colours["edge"])
    if lane:
        left = x - wide / 2 + CHIP_SIDES / 2
        yield polygon(house(left - 1.0, y), "none", colours["acc"])
        words, at = lane_words(count), (left + HOUSE / 2 + 3.0, y + 4.0)
        yield text(at, words, TEXT, colours["tx"], 500, "start")
    else:
        yield text((x, y + 4.0), str(count), TEXT, colours["tx"], 600)
    yield "</g>"


def draw_stubs(figure: Figure, states: Collection[int], colours: Colours) -> Iterator[str]:
    """Yield marks for those of the states from which operations lead back through the lane."""
    drawn = set(states) if figure.shows_nodes else set()
    for state in (one for one in figure.picture.stubs if one in drawn):
        line = stub_of(figure.geometry.box(state), 1.0)
        x, y = line[-1]
        yield polyline(line, colours["slate"], 1.5)
        yield polyline([(x + 4.0, y - 4.0), (x, y), (x + 4.0, y + 4.0)], colours["slate"], 1.5)


def _words(figure: Figure, edge: int) -> str:
    """Return the operations of a bundle, one in each line, with their states."""
    picture = figure.picture
    names, source, target = picture.names, picture.source, picture.target
    own = picture.bundles.members[edge]
    return "\n".join(
        f"{names[source[one]]} -> {picture.operations[one]} -> {names[target[one]]}" for one in own
    )
