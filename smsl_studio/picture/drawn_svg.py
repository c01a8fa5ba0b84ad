"""The drawing of notes and groups as SVG."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from smsl_studio.legible import markup
from smsl_studio.picture.colours import Colours
from smsl_studio.picture.drawn_parts import (
    ABOVE,
    BAR,
    BY_LINE,
    CORNER,
    FOLD,
    GROUP_RADIUS,
    INSET,
    LINE,
    TEXT,
    by_words,
    lines_of,
    nearest_point,
)
from smsl_studio.picture.figure import Figure
from smsl_studio.picture.strokes import box, number, polyline, text
from smsl_studio.picture.words import elided, width


def draw_groups(figure: Figure, groups: Iterable[int], colours: Colours) -> Iterator[str]:
    """Yield the frames of groups, with the bars for their titles. All else lies above them."""
    rects = figure.group_rects
    for group in groups:
        left, top, right, bottom = rects[group].tolist()
        wide = right - left
        frame = (left, top, wide, bottom - top)
        title = figure.drawn.groups[group].title
        yield "<g>"
        yield f"<title>{markup(title)}</title>"
        yield box(frame, GROUP_RADIUS, colours["sunk"], colours["line2"])
        if figure.bar:
            r, across = number(GROUP_RADIUS), number(wide - 2 * GROUP_RADIUS)
            yield (
                f'<path d="M{number(left)} {number(top + BAR)}v{number(GROUP_RADIUS - BAR)}'
                f"a{r} {r} 0 0 1 {r} -{r}h{across}a{r} {r} 0 0 1 {r} {r}"
                f'v{number(BAR - GROUP_RADIUS)}z" fill="{colours["line"]}"/>'
            )
        yield "</g>"


def draw_titles(figure: Figure, groups: Iterable[int], colours: Colours) -> Iterator[str]:
    """Yield the titles of groups. They lie above lines and have a background of their own."""
    rects = figure.title_rects
    for group in groups if figure.bar else ():
        left, top, right, _ = rects[group].tolist()
        middle = (left + right) / 2
        words = elided(figure.drawn.groups[group].title, TEXT, right - left - 2 * INSET)
        wide = width(words, TEXT) + INSET
        yield box((middle - wide / 2, top + 2.0, wide, BAR - 3.0), 0.0, colours["line"])
        yield text((middle, top + BAR / 2 + 4.0), words, TEXT, colours["tx2"], 600)


def draw_notes(figure: Figure, notes: Iterable[int], colours: Colours) -> Iterator[str]:
    """Yield notes, each with a line to the state that it hangs on."""
    rects = figure.note_rects
    for number_ in notes:
        note, state = figure.drawn.notes[number_], int(figure.drawn.states[number_])
        left, top, right, bottom = rects[number_].tolist()
        if state >= 0:
            at = figure.at[state].tolist()
            end = nearest_point((left, top, right, bottom), (at[0], at[1]))
            yield polyline([end, (at[0], at[1])], colours["nl"], 1.0, "2 3")
        yield from _sheet((left, top, right, bottom), colours)
        y = top + ABOVE + 11.0
        for line in lines_of(note):
            yield text((left + INSET, y), line, TEXT, colours["tx"], 400, "start")
            y += LINE
        by = by_words(note.author, note.date)
        if by:
            y = bottom - ABOVE - BY_LINE + 14.0
            yield text((left + INSET, y), by, TEXT, colours["tx3"], 400, "start")


def _sheet(rect: tuple[float, float, float, float], colours: Colours) -> Iterator[str]:
    """Yield a sheet of paper with its upper right corner folded."""
    left, top, right, bottom = rect
    r, fold = number(CORNER), number(FOLD)
    wide, high = right - left, bottom - top
    look = f'stroke="{colours["nl"]}" stroke-width="1" stroke-linejoin="round"'
    yield (
        f'<path d="M{number(left + CORNER)} {number(top)}h{number(wide - FOLD - CORNER)}'
        f"l{fold} {fold}v{number(high - FOLD - CORNER)}a{r} {r} 0 0 1 -{r} {r}"
        f"h{number(2 * CORNER - wide)}a{r} {r} 0 0 1 -{r} -{r}v{number(2 * CORNER - high)}"
        f'a{r} {r} 0 0 1 {r} -{r}z" fill="{colours["surf"]}" {look}/>'
    )
    yield (
        f'<path d="M{number(right - FOLD)} {number(top)}v{fold}h{fold}z" '
        f'fill="{colours["sunk"]}" {look}/>'
    )
