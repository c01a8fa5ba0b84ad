"""A difference as pictures: the changes in words, then both sides of every SB that has changed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.comparison import Change, Difference
from smsl_studio.blueprint.comparison.signs import Signs, sign_of, signs_of
from smsl_studio.picture.aligned import changed_pairs, places_of
from smsl_studio.picture.colours import LIGHT, Colours
from smsl_studio.picture.crowd import crowd_of, refuse_too_many
from smsl_studio.picture.figure import Figure
from smsl_studio.picture.panel import EDGE, SvgPanel, panel_of
from smsl_studio.picture.picture import Picture
from smsl_studio.picture.shape import Point
from smsl_studio.picture.signs import WORDS, sign_at
from smsl_studio.picture.strokes import text
from smsl_studio.picture.words import elided, width

MOST_ROWS = 40
ROW, SIZE, TITLE = 22.0, 13.0, 16.0
WIDE = 900.0
BETWEEN = 12.0


def draw_difference(
    difference: Difference, colours: Colours = LIGHT, collapsed: bool = False
) -> list[SvgPanel]:
    """Return a panel with words, and one panel for each SB that has changed.

    With ``collapsed``, unchanged operations between the same two states are one line. UsageError if
    there are too many SBs.
    """
    signs = signs_of(difference)
    panels = [_in_words(difference, colours)]
    pairs = changed_pairs(difference)
    sides = difference.before, difference.after
    names = [[pair[i] for pair in pairs if pair[i]] for i in (0, 1)]
    crowd = 0
    for blueprint, chosen in zip(sides, names, strict=True):
        refuse_too_many(blueprint, chosen, "Leave out -o to have the changes in words.")
        crowd += crowd_of(blueprint, chosen)
    for pair in pairs:
        places = places_of(difference, *pair)
        drawn = [
            _side(
                _shown(Picture(sides[i], pair[i], crowd), signs[i], collapsed),
                ("before", "after")[i],
                signs[i],
                places[i],
                colours,
            )
            for i in (0, 1)
            if pair[i]
        ]
        panels.append(_beside(drawn))
    return panels


def _shown(picture: Picture, signs: Signs, collapsed: bool) -> Picture:
    """Return the picture, collapsed if wanted. Changed operations are drawn by themselves."""
    return picture.collapse(_signed(picture, signs)) if collapsed else picture


def _signed(picture: Picture, signs: Signs) -> dict[int, str]:
    """Return the number of each changed operation, with its sign."""
    edges = range(len(picture.operations))
    return {e: sign for e in edges if (sign := signs.of(picture.address(e)))}


def _side(
    picture: Picture, word: str, signs: Signs, places: Mapping[str, Point], colours: Colours
) -> SvgPanel:
    name = picture.branch.name
    states = {
        i: sign for i, state in enumerate(picture.names) if (sign := signs.of(Address(name, state)))
    }
    operations = _signed(picture, signs)
    figure = Figure(picture, places, frozenset(operations))
    return panel_of(figure, name, word, colours, states, operations)


def _beside(panels: list[SvgPanel]) -> SvgPanel:
    x, parts = 0.0, []
    for panel in panels:
        parts.append(panel.at(x, 0.0))
        x += panel.width + BETWEEN
    return SvgPanel(x - BETWEEN, max(panel.height for panel in panels), "\n".join(parts))


def _in_words(difference: Difference, colours: Colours) -> SvgPanel:
    files = f"{difference.before.file}  →  {difference.after.file}"
    parts = [
        text((EDGE, 30.0), elided(files, TITLE, WIDE), TITLE, colours["tx"], 600, "start"),
        text((EDGE, 54.0), difference.words, SIZE, colours["tx2"], 400, "start"),
    ]
    parts.extend(_key(colours))
    rows, y = _rows(difference.changes, 104.0, colours, "tx")
    parts.extend(rows)
    if difference.fields:
        words = "Beside the meaning"
        parts.append(text((EDGE, y), words, SIZE, colours["tx2"], 600, "start"))
        rows, y = _rows(difference.fields, y + ROW, colours, "tx2")
        parts.extend(rows)
    return SvgPanel(WIDE + 3 * EDGE, y + 8.0, "\n".join(parts))


def _rows(
    changes: Sequence[Change], y: float, colours: Colours, ink: str
) -> tuple[list[str], float]:
    """Return the SVG of the changes, one row each from height ``y``, and the height below them."""
    parts: list[str] = []
    for change in changes[:MOST_ROWS]:
        sign = sign_of(change.kind)
        parts.extend(sign_at((EDGE + 7.0, y - 4.5), sign, colours))
        words = elided(change.words, SIZE, WIDE)
        parts.append(text((EDGE + 22.0, y), words, SIZE, colours[ink], 400, "start"))
        y += ROW
    left = len(changes) - MOST_ROWS
    if left > 0:
        parts.append(text((EDGE + 22.0, y), f"and {left} more", SIZE, colours["tx3"], 400, "start"))
        y += ROW
    return parts, y


def _key(colours: Colours) -> Iterator[str]:
    x = EDGE
    for sign, words in WORDS.items():
        yield from sign_at((x + 6.0, 73.5), sign, colours, 6.0)
        yield text((x + 18.0, 78.0), words, 12.0, colours["tx3"], 400, "start")
        x += width(words, 12.0) + 42.0
