"""The map of branches as SVG, for files and documents."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import PurePath

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.picture.branch_map import (
    HEAD,
    ROW,
    SKETCH,
    WIDE,
    BranchMap,
    MapCard,
    MapLink,
    branch_map,
)
from smsl_studio.picture.colours import Colours
from smsl_studio.picture.miniature import Miniature, miniature_of_branch
from smsl_studio.picture.panel import SvgPanel
from smsl_studio.picture.strokes import box, circle, polygon, polyline, text
from smsl_studio.picture.svg import size_words
from smsl_studio.picture.words import elided
from smsl_studio.stop import heed

EDGE = 12.0
MOST_SKETCHED = 400
"""If there are more SBs than this, cards have no small drawings, because these take too long."""


def map_panel(blueprint: Blueprint, colours: Colours) -> SvgPanel:
    """Return the map of all SBs of a blueprint as a panel."""
    drawn = branch_map(blueprint)
    parts = [part for link in drawn.links for part in _link(link, colours)]
    few = len(drawn.cards) <= MOST_SKETCHED
    for card in drawn.cards.values():
        heed()
        sketch = miniature_of_branch(blueprint, card.name) if few else None
        parts.extend(_card(card, sketch, colours))
    return SvgPanel(*_size(drawn), "\n".join(parts))


def _size(drawn: BranchMap) -> tuple[float, float]:
    """Return the width and the height of the map, with the borders of the outermost cards."""
    return max(drawn.width + 1.0, 160.0), max(drawn.height + 1.0, 20.0)


def _link(link: MapLink, colours: Colours) -> Iterator[str]:
    yield polyline(link.line, colours["edge"], 1.5)
    x, y = link.line[-1]
    yield polygon(((x, y), (x - 8.0, y - 4.0), (x - 8.0, y + 4.0)), colours["edge"])


def _card(card: MapCard, sketch: Miniature | None, colours: Colours) -> Iterator[str]:
    x, y = card.left, card.top
    yield box((x, y, WIDE, card.height), 8.0, colours["surf"], colours["line2"])
    yield box((x + 1, y + HEAD, WIDE - 2, SKETCH), 0.0, colours["canvas"])
    room = WIDE - 2 * EDGE
    yield text((x + EDGE, y + 20.0), elided(card.name, 13.0, room), 13.0, colours["tx"], 600,
               "start")  # fmt: skip
    words = size_words(card.states, card.operations)
    if card.file:
        words = f"{words}, in {PurePath(card.file).name}"
    yield text((x + EDGE, y + 36.0), elided(words, 11.0, room), 11.0, colours["tx3"], 400, "start")
    if sketch is not None:
        yield from _sketch(sketch, x + EDGE, y + HEAD + 8.0, colours)
    middle = y + HEAD + SKETCH + ROW / 2
    for fact in card.facts:
        yield circle((x + WIDE, middle), 3.5, colours["bad" if fact.missing else "acc"])
        words = f"{fact.name}: {fact.sub}{', which does not exist' if fact.missing else ''}"
        yield text((x + EDGE, middle + 4.0), elided(words, 11.0, room), 11.0, colours["tx2"], 400,
                   "start")  # fmt: skip
        middle += ROW
    if card.plain:
        words = plain_words(card)
        yield text((x + EDGE, middle + 4.0), words, 11.0, colours["tx3"], 400, "start")


def plain_words(card: MapCard) -> str:
    """Return the words about the facts that no sub-SB expands."""
    other = "other " if card.facts else ""
    return f"{card.plain} {other}fact{'' if card.plain == 1 else 's'}"


def _sketch(sketch: Miniature, x: float, y: float, colours: Colours) -> Iterator[str]:
    inside = sketch.within(WIDE - 2 * EDGE, SKETCH - 16.0)
    places = [(x + left, y + top) for left, top in inside.tolist()]
    for source, target in sketch.lines.tolist():
        yield polyline((places[source], places[target]), colours["edge"], 1.0)
    radius = 4.0 if len(places) <= 30 else 2.5 if len(places) <= 150 else 1.5
    for number, (left, top) in enumerate(places):
        colour = colours["acc"] if number == sketch.activating else colours["slate"]
        yield circle((left, top), radius, colour)
