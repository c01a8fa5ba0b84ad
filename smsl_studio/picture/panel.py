"""One SB with its title and its legend, as a piece of SVG whose size is known."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from smsl_studio.picture.bundle_svg import draw_stubs
from smsl_studio.picture.colours import Colours
from smsl_studio.picture.drawn_svg import draw_groups, draw_notes, draw_titles
from smsl_studio.picture.facts_key import facts_key
from smsl_studio.picture.figure import Figure
from smsl_studio.picture.guards import MEANING
from smsl_studio.picture.lines import NO_SIGNS, draw_labels, draw_lines, guard_at, sub_mark_at
from smsl_studio.picture.nodes import draw_node
from smsl_studio.picture.picture import Picture
from smsl_studio.picture.returns import house
from smsl_studio.picture.strokes import box, number, polygon, text
from smsl_studio.picture.sub_marks import mark_words
from smsl_studio.picture.words import elided, width

TITLE, NOTE = 16.0, 12.0
HEAD, ROW, EDGE = 46.0, 18.0, 24.0
LEAST = 420.0


@dataclass(frozen=True)
class SvgPanel:
    """A piece of SVG whose upper left corner is at (0, 0)."""

    width: float
    height: float
    svg: str

    def at(self, x: float, y: float) -> str:
        """Return the SVG of the panel with its upper left corner at a point (pixels)."""
        return f'<g transform="translate({number(x)} {number(y)})">{self.svg}</g>'


def panel_of(
    figure: Figure,
    title: str,
    note: str,
    colours: Colours,
    states: Mapping[int, str] = NO_SIGNS,
    operations: Mapping[int, str] = NO_SIGNS,
) -> SvgPanel:
    """Return the panel of one SB. ``states`` and ``operations`` have the signs of a difference by
    number.
    """
    left, top, right, bottom = figure.bounds()
    rows = list(_legend(figure, right - left, colours))
    wide = max(right - left + 2 * EDGE, LEAST, *(row[1] + 2 * EDGE for row in rows), 0.0)
    high = HEAD + bottom - top + 2 * EDGE + ROW * len(rows)
    parts = [*_title(title, note, wide, colours)]
    x, y = (wide - right - left) / 2, HEAD + EDGE - top
    parts.append(f'<g transform="translate({number(x)} {number(y)})">')
    edges = range(len(figure.picture.operations))
    notes, groups = figure.drawn_with(None)
    parts.extend(draw_groups(figure, groups, colours))
    parts.extend(draw_lines(figure, edges, colours, operations))
    parts.extend(draw_stubs(figure, range(len(figure.picture)), colours))
    parts.extend(draw_titles(figure, groups, colours))
    parts.extend(draw_notes(figure, notes, colours))
    for state in range(len(figure.picture)):
        parts.extend(draw_node(figure, state, colours, states.get(state, "")))
    parts.extend(draw_labels(figure, edges, colours, operations))
    if not len(figure.picture) and not figure.drawn:
        parts.append(text((80.0, 14.0), "no states", NOTE, colours["tx3"]))
    parts.append("</g>")
    below = HEAD + bottom - top + 2 * EDGE
    for row, (svg, _) in enumerate(rows):
        parts.append(f'<g transform="translate({number(EDGE)} {number(below + row * ROW)})">')
        parts.append(f"{svg}</g>")
    return SvgPanel(wide, high + (12.0 if rows else 0.0), "\n".join(parts))


def _title(title: str, note: str, wide: float, colours: Colours) -> Iterator[str]:
    shown = elided(title, TITLE, wide * 0.6)
    yield text((EDGE, 30.0), shown, TITLE, colours["tx"], 600, "start")
    x = EDGE + width(shown, TITLE) + 14.0
    yield text((x, 30.0), elided(note, NOTE, wide - x - EDGE), NOTE, colours["tx3"], 400, "start")


def _legend(figure: Figure, across: float, colours: Colours) -> Iterator[tuple[str, float]]:
    """Yield the rows below the figure with their widths: what is left out, and the meaning of
    facts and marks. ``across`` is the width of the figure (pixels).
    """
    picture = figure.picture
    words: list[tuple[str, str]] = []
    if picture.prefix and figure.shows_labels:
        words.append(("", _prefix_words(picture)))
    if not figure.shows_labels and picture.operations:
        words.append(("", "The names of the operations are left out: there are too many."))
    if not figure.shows_nodes:
        words.append(("", "Each dot is a state: there are too many to show their names."))
    if figure.shows_facts:
        room = max(across, LEAST)
        words.extend(("", row) for row in facts_key(picture.branch, NOTE, room))
    if figure.shows_nodes and picture.branch.subs:
        subs = "; ".join(
            f"{picture.branch.fact_name(digit)} by {sub}"
            for digit, sub in picture.branch.subs.items()
        )
        words.append(("bar", f"expanded by a sub-SB: {elided(subs, NOTE, LEAST)}"))
    if figure.shows_nodes:
        words.extend(_bundle_words(picture))
    if figure.shows_labels:
        named = [e for e in range(len(picture.operations)) if e not in picture.bundles.first]
        kinds = {picture.kind(edge) for edge in named}
        if any(picture.guards(edge) for edge in named):
            words.append(("guard", MEANING))
        for kind, meaning in mark_words(picture.branch, kinds).items():
            words.append((kind, elided(meaning, NOTE, LEAST)))
    for mark, line in words:
        yield "".join(_row(mark, line, colours)), width(line, NOTE) + (18.0 if mark else 0.0)


def _prefix_words(picture: Picture) -> str:
    """Say what is left out of the names of operations, and name one that is written in full."""
    prefix = elided(picture.prefix, NOTE, LEAST / 2)
    whole = f"The name of every operation here begins with {prefix}"
    names = picture.branch.operation_names
    others = [name for name in names if not name.startswith(picture.prefix)]
    if not others:
        return whole
    more = f" and {len(others) - 1:,} more" if len(others) > 1 else ""
    return f"{whole}, except {elided(others[0], NOTE, LEAST / 2)}{more}"


def _bundle_words(picture: Picture) -> Iterator[tuple[str, str]]:
    """Yield the marks of bundles in the picture, with their meanings."""
    laned = picture.bundles.lane >= 0
    if len(picture.bundles.members) > laned:
        yield "", "A number on a line: so many operations between these two states."
    if laned:
        yield "house", "on a line: so many operations lead far back to the start"
        yield "", "↵ below a state: one of them leads from there."


def _row(mark: str, words: str, colours: Colours) -> Iterator[str]:
    if mark == "bar":
        yield box((0.0, 7.0, 13.0, 2.0), 1.0, colours["acc"])
    elif mark == "house":
        yield polygon(house(6.0, 7.0), "none", colours["acc"])
    elif mark == "guard":
        yield from guard_at((6.0, 8.0), colours)
    elif mark:
        yield from sub_mark_at((6.0, 8.0), mark, colours)
    yield text((20.0 if mark else 0.0, 12.0), words, NOTE, colours["tx2"], 400, "start")
