"""DrawnParts: the notes and groups of one SB, and where they lie on its drawing. It knows no Qt."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import date
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from smsl_studio.blueprint.annotations import DrawnNote
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.legible import one_line
from smsl_studio.picture.shape import Floats, Point
from smsl_studio.picture.words import broken, elided, width

NOTE_WIDTH, FOLD, CORNER, INSET, ABOVE, BELOW = 160.0, 14.0, 3.0, 12.0, 9.0, 9.0
"""The width of a note, the side of its folded corner, the radius of the others, and the room around
its words (pixels)."""
TEXT, LINE, BY_LINE = 11.0, 15.0, 18.0
"""The size of a note's text, and the height of a line of it and of that with its author."""
MOST_LINES = 12
"""At most this many lines of a note are drawn; the window shows the others when it is edited."""
AROUND, BAR, GROUP_RADIUS = 14.0, 24.0, 10.0
"""The room in a group around its states, the height of its title, and the radius of its corners."""
ARROW = 22.0
"""How far the arrow at the left of INITIAL reaches (pixels)."""
Rect = tuple[float, float, float, float]
NO_LOOPS: Mapping[int, Floats] = {}
Members = tuple[NDArray[np.intp], ...]
"""The numbers of the states in each group."""
_MONTHS = ["Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"]


class DrawnParts:
    """The notes and groups of one SB by number, in written order.

    Rectangles are left, top, right, bottom in scene units, (n, 4).
    """

    def __init__(self, branch: StateBranch, index: Mapping[str, int]) -> None:
        """``index`` has the numbers of the states."""
        drawn = branch.drawn
        self._initial = index.get(branch.initial, -1)
        self.note_keys, self.notes = tuple(drawn.notes), tuple(drawn.notes.values())
        self.group_keys, self.groups = tuple(drawn.groups), tuple(drawn.groups.values())
        self.states: NDArray[np.intp] = np.array(
            [index.get(note.state, -1) for note in self.notes], dtype=np.intp
        )
        """For each note the number of the state that it hangs on, -1 if it is free."""
        self.members: Members = tuple(
            np.array([index[name] for name in group.states], dtype=np.intp) for group in self.groups
        )
        """The numbers of the states in each group."""
        at = [note.at for note in self.notes]
        high = [note_height(note) for note in self.notes]
        self._at: Floats = np.array(at, dtype=np.float64).reshape(-1, 2)
        self._size: Floats = np.column_stack([np.full(len(high), NOTE_WIDTH), high])

    def __bool__(self) -> bool:
        return bool(self.notes or self.groups)

    def note_rects(self, at: Floats, scale: float = 1.0) -> Floats:
        """Return where the notes lie. ``at`` has the centres of the states, in a layout that is
        drawn ``scale`` times as large as it is written.
        """
        corner = self._at * scale
        hung = self.states >= 0
        if hung.any():
            corner[hung] += at[self.states[hung]]
        return np.hstack([corner, corner + self._size])

    def group_rects(
        self,
        boxes: Floats,
        unit: float = 1.0,
        bar: float = BAR,
        members: Members | None = None,
        loops: Mapping[int, Floats] = NO_LOOPS,
    ) -> Floats:
        """Return the frames of the groups, (n, 4).

        ``boxes`` has the centre and half the size of each node. ``unit`` is the number of scene
        units in a pixel, ``bar`` the height of titles (pixels). ``members`` replaces the states
        that the blueprint lists for each group. ``loops`` has for states what their loops and the
        names of these cover, (m, 4). Such loops are below and beside their states, so a frame is as
        high as without them, and its title stays where no name may stand.
        """
        found = np.zeros((len(self.groups), 4))
        for number, states in enumerate(self.members if members is None else members):
            own = boxes[states]
            low = own[:, :2] - own[:, 2:]
            low[states == self._initial, 0] -= ARROW * unit
            found[number, :2] = low.min(axis=0)
            found[number, 2:] = (own[:, :2] + own[:, 2:]).max(axis=0)
            for rects in (loops[state] for state in states.tolist() if state in loops):
                found[number, 0] = min(found[number, 0], rects[:, 0].min())
                found[number, 2:] = np.maximum(found[number, 2:], rects[:, 2:].max(axis=0))
        return found + np.array([-AROUND, -AROUND - bar, AROUND, AROUND]) * unit

    def readable(self, boxes: Floats, unit: float = 1.0, scale: float = 1.0) -> list[Rect]:
        """Return where words stand that nothing may cover: the notes, and the words of the titles
        of groups. The arguments are those of ``group_rects`` and ``note_rects``.
        """
        if not self:
            return []
        frames, titles = self.group_rects(boxes, unit), np.zeros((len(self.groups), 4))
        for number, group in enumerate(self.groups):
            left, top, right, _ = frames[number].tolist()
            room = max((right - left) / unit - 2 * INSET, 8.0)
            half = (width(elided(one_line(group.title), TEXT, room), TEXT) + INSET) / 2 * unit
            middle = (left + right) / 2
            titles[number] = middle - half, top, middle + half, top + BAR * unit
        found = np.vstack([self.note_rects(boxes[:, :2], scale), titles]).tolist()
        return [(left, top, right, bottom) for left, top, right, bottom in found]


def lines_of(note: DrawnNote) -> tuple[str, ...]:
    """Return the lines of a note that are drawn."""
    return _lines(note.text)


def note_height(note: DrawnNote) -> float:
    """Return the height of a note (pixels)."""
    by = BY_LINE if note.author or note.date else 0.0
    return ABOVE + LINE * max(len(lines_of(note)), 1) + by + BELOW


def nearest_point(rect: tuple[float, float, float, float], at: Point) -> Point:
    """Return the point of a rectangle that is nearest to a point."""
    left, top, right, bottom = rect
    return min(max(at[0], left), right), min(max(at[1], top), bottom)


@lru_cache(maxsize=20_000)
def by_words(author: str, day: str) -> str:
    """Return who wrote a note and when, such as ``R. Stein, 12 Nov 2026``, as it is drawn."""
    words = ", ".join(part for part in (author, day_words(day)) if part)
    return elided(one_line(words), TEXT, NOTE_WIDTH - 2 * INSET)


def day_words(day: str) -> str:
    """Return a day as people write it. A text that is no day stays as it is."""
    try:
        found = date.fromisoformat(day)
    except ValueError:
        return day
    return f"{found.day} {_MONTHS[found.month - 1]} {found.year}"


@lru_cache(maxsize=20_000)
def _lines(text: str) -> tuple[str, ...]:
    return tuple(broken(text, TEXT, NOTE_WIDTH - 2 * INSET, MOST_LINES))
