"""A difference as a picture: what changed in words, then both sides of every SB that did."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.comparing import Difference
from smsl_studio.blueprint.comparing.signs import Signs, signs_of
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.graph.layout import place_states
from smsl_studio.picture.colours import LIGHT, Colours
from smsl_studio.picture.figure import Figure
from smsl_studio.picture.panel import EDGE, Panel, panel_of
from smsl_studio.picture.picture import Picture
from smsl_studio.picture.shape import Point
from smsl_studio.picture.signs import WORDS, sign_at
from smsl_studio.picture.strokes import text
from smsl_studio.picture.words import elided, width

MOST_ROWS = 40
ROW, SIZE, TITLE = 22.0, 13.0, 16.0
WIDE = 900.0
BETWEEN = 12.0


def draw_difference(difference: Difference, colours: Colours = LIGHT) -> list[Panel]:
    """The words first, then a panel for each SB that changed."""
    signs = signs_of(difference)
    panels = [_in_words(difference, colours)]
    for before, after in _branches(difference, signs):
        sides = [
            _side(difference.before, before, "before", signs[0], colours, difference, after),
            _side(difference.after, after, "after", signs[1], colours, difference, ""),
        ]
        panels.append(_beside([side for side in sides if side is not None]))
    return panels


def _branches(difference: Difference, signs: tuple[Signs, Signs]) -> Iterator[tuple[str, str]]:
    """The names of every SB that changed, on both sides; empty where it is not there."""
    touched = [{address.branch for address in side.by_address} for side in signs]
    for name in difference.after.branches:
        old = next((o for o, new in difference.branches.items() if new == name), name)
        if name in touched[1] or old in touched[0]:
            yield old if old in difference.before.branches else "", name
    for name in difference.before.branches:
        if name in touched[0] and difference.branches.get(name, name) not in (
            difference.after.branches
        ):
            yield name, ""


def _side(
    blueprint: Blueprint,
    name: str,
    word: str,
    signs: Signs,
    colours: Colours,
    difference: Difference,
    other: str,
) -> Panel | None:
    if not name:
        return None
    picture = Picture(blueprint, name)
    states = {
        i: sign for i, state in enumerate(picture.names) if (sign := signs.of(Address(name, state)))
    }
    edges = range(len(picture.operations))
    operations = {e: sign for e in edges if (sign := signs.of(picture.address(e)))}
    former = _as_on(difference, name, other) if other else {}
    positions = place_states(blueprint[name], former)
    figure = Figure(picture, positions, frozenset(operations))
    return panel_of(figure, name, word, colours, states, operations)


def _as_on(difference: Difference, before: str, after: str) -> Mapping[str, Point]:
    """The states of the earlier side where the later one has them."""
    renamed = difference.states.get(before, {})
    places = place_states(difference.after[after])
    found = {name: renamed.get(name, name) for name in difference.before[before].table}
    return {name: places[new] for name, new in found.items() if new in places}


def _beside(panels: list[Panel]) -> Panel:
    x, parts = 0.0, []
    for panel in panels:
        parts.append(panel.at(x, 0.0))
        x += panel.width + BETWEEN
    return Panel(x - BETWEEN, max(panel.height for panel in panels), "\n".join(parts))


def _in_words(difference: Difference, colours: Colours) -> Panel:
    files = f"{difference.before.file}  →  {difference.after.file}"
    parts = [
        text((EDGE, 30.0), elided(files, TITLE, WIDE), TITLE, colours["tx"], 600, "start"),
        text((EDGE, 54.0), difference.words, SIZE, colours["tx2"], 400, "start"),
    ]
    parts.extend(_key(colours))
    y = 104.0
    for change in difference.changes[:MOST_ROWS]:
        sign = {"added": "+", "removed": "-"}.get(change.kind.value, "~")
        parts.extend(sign_at((EDGE + 7.0, y - 4.5), sign, colours))
        words = elided(change.words, SIZE, WIDE)
        parts.append(text((EDGE + 22.0, y), words, SIZE, colours["tx"], 400, "start"))
        y += ROW
    left = len(difference.changes) - MOST_ROWS
    if left > 0:
        parts.append(text((EDGE + 22.0, y), f"and {left} more", SIZE, colours["tx3"], 400, "start"))
        y += ROW
    return Panel(WIDE + 3 * EDGE, y + 8.0, "\n".join(parts))


def _key(colours: Colours) -> Iterator[str]:
    x = EDGE
    for sign, words in WORDS.items():
        yield from sign_at((x + 6.0, 73.5), sign, colours, 6.0)
        yield text((x + 18.0, 78.0), words, 12.0, colours["tx3"], 400, "start")
        x += width(words, 12.0) + 42.0
