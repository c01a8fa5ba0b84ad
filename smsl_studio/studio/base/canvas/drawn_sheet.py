"""DrawnSheet: the notes and groups of a sheet, where they lie now, and which one is at a point."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import chain
from typing import Protocol

import numpy as np
from PySide6.QtCore import QRectF

from smsl_studio.picture.drawn_parts import BAR, DrawnParts, Members, by_words, day_words, lines_of
from smsl_studio.picture.geometry import Geometry
from smsl_studio.picture.levels import Level
from smsl_studio.picture.picture import Picture
from smsl_studio.picture.shape import Floats
from smsl_studio.studio.base.paint.drawn_paint import READABLE, title_place
from smsl_studio.studio.base.paint.ink import Ink

NO_FRAMES = np.zeros((0, 4)), np.zeros((0, 4))


@dataclass(frozen=True)
class DrawnKey:
    """A note or a group of the SB that is shown: ``kind`` is ``note`` or ``group``."""

    kind: str
    key: str


class Laid(Protocol):
    """The parts of a sheet that say where notes and groups lie."""

    picture: Picture
    ink: Ink
    at: Floats
    unit: float
    zoom: float
    level: Level
    version: int

    @property
    def geometry(self) -> Geometry:
        """The lines and the places of labels."""

    def halves(self) -> Floats:
        """Half the width and height of every node, (n, 2), in scene units."""


class DrawnSheet:
    """The notes and groups of one sheet. Rectangles are left, top, right, bottom (scene units)."""

    def __init__(self, sheet: Laid) -> None:
        self._sheet = sheet
        self._parts = DrawnParts(sheet.picture.branch, sheet.picture.index)
        self._of: object = sheet.picture.branch.drawn
        self._notes: tuple[object, Floats] = None, np.zeros((0, 4))
        self._groups: tuple[object, tuple[Floats, Floats]] = None, NO_FRAMES
        self._aside: tuple[int, float, float] | None = None
        self._members: Members | None = None
        self.gains: frozenset[int] = frozenset()
        """The numbers of the groups that would get a state that is being dragged."""

    def __bool__(self) -> bool:
        return bool(self._sheet.picture.branch.drawn)

    @property
    def parts(self) -> DrawnParts:
        """The notes and groups as they are written."""
        branch = self._sheet.picture.branch
        if self._of is not branch.drawn:
            self._of, self._parts = branch.drawn, DrawnParts(branch, self._sheet.picture.index)
            self._members = None
        return self._parts

    @property
    def members(self) -> Members:
        """The states of each group as they are shown, by number."""
        written = self.parts.members
        return written if self._members is None else self._members

    def put_members(self, members: Members | None) -> None:
        """Show other states in the groups during a drag. None shows those of the blueprint."""
        written = self.parts.members
        self._members = members
        pairs = enumerate(zip(self.members, written, strict=True))
        self.gains = frozenset(n for n, (now, own) in pairs if len(np.setdiff1d(now, own)))
        self._groups = None, NO_FRAMES

    @property
    def bar(self) -> float:
        """The height of the titles of groups (pixels); 0 where states are boxes or dots."""
        return BAR if self._sheet.level >= Level.COMPACT else 0.0

    @property
    def note_rects(self) -> Floats:
        """Where the notes lie."""
        parts, aside = self.parts, self._aside
        state = parts, self._sheet.version, aside
        if self._notes[0] != state:
            found = parts.note_rects(self._sheet.at)
            if aside is not None and aside[0] < len(found):
                number, x, y = aside
                found[number] += np.tile(np.array([x, y]) - found[number, :2], 2)
            self._notes = state, found
        return self._notes[1]

    @property
    def group_rects(self) -> Floats:
        """Where the frames of the groups lie."""
        return self._all_frames()[0]

    @property
    def title_rects(self) -> Floats:
        """The rectangles over which the titles of groups stand in the middle, without loops."""
        return self._all_frames()[1]

    def _all_frames(self) -> tuple[Floats, Floats]:
        """The frames of the groups with and without loops, for the present places and zoom."""
        sheet, parts = self._sheet, self.parts
        state = parts, sheet.version, sheet.unit, sheet.level
        if self._groups[0] != state:
            loops, bare = self._loops(), self._frames_around({})
            self._groups = state, (self._frames_around(loops) if loops else bare, bare)
        return self._groups[1]

    def _frames_around(self, loops: Mapping[int, Floats]) -> Floats:
        sheet = self._sheet
        boxes = np.hstack([sheet.at, sheet.halves()])
        return self.parts.group_rects(boxes, sheet.unit, self.bar, self.members, loops)

    def _loops(self) -> Mapping[int, Floats]:
        """What the loops of states in groups cover, where lines are drawn one by one."""
        if not self.parts.groups or not self.bar:
            return {}
        states = chain.from_iterable(own.tolist() for own in self.members)
        return self._sheet.geometry.loops_of(states)

    def lay_aside(self, number: int, x: float, y: float) -> None:
        """Show a note with its upper left corner elsewhere, during a drag."""
        self._aside = number, x, y

    def lay_back(self) -> None:
        """Show all notes where they belong."""
        self._aside = None

    def number(self, key: DrawnKey) -> int:
        """The number of a note or group, -1 if there is none."""
        parts = self.parts
        keys = parts.note_keys if key.kind == "note" else parts.group_keys
        return keys.index(key.key) if key.key in keys else -1

    def listed(self) -> list[DrawnKey]:
        """All groups and notes: groups first, in written order."""
        parts = self.parts
        return [
            *(DrawnKey("group", key) for key in parts.group_keys),
            *(DrawnKey("note", key) for key in parts.note_keys),
        ]

    def rect(self, key: DrawnKey) -> QRectF | None:
        """Where a note or the frame of a group lies; None if there is none."""
        number = self.number(key)
        if number < 0:
            return None
        return _rect((self.note_rects if key.kind == "note" else self.group_rects)[number])

    def title_rect(self, key: DrawnKey) -> QRectF | None:
        """Where the title of a group lies; None if there is no such group."""
        rect = self.rect(key)
        if rect is not None:
            rect.setHeight(BAR * self._sheet.unit)
        return rect

    def words_at(self, x: float, y: float) -> bool:
        """Whether a scene point is on the words of a group's title, which cover lines."""
        number, sheet = self.title_at(x, y), self._sheet
        if number < 0:
            return False
        left, top, right, bottom = (self.title_rects[number] / sheet.unit).tolist()
        frame = QRectF(left, top, right - left, bottom - top)
        place = title_place(frame, self.parts.groups[number].title, self.bar, sheet.ink)[1]
        return place.contains(x / sheet.unit, y / sheet.unit)

    def note_at(self, x: float, y: float) -> int:
        """The number of the note at a scene point, the topmost one; -1 for none."""
        return _at(self.note_rects, x, y) if self else -1

    def title_at(self, x: float, y: float) -> int:
        """The number of the group whose title is at a scene point, -1 for none."""
        if not self or not self.bar:
            return -1
        bars = self.group_rects.copy()
        bars[:, 3] = bars[:, 1] + self.bar * self._sheet.unit
        return _at(bars, x, y)

    def at(self, x: float, y: float) -> DrawnKey | None:
        """The note, else the title of a group, at a scene point."""
        note = self.note_at(x, y)
        if note >= 0:
            return DrawnKey("note", self.parts.note_keys[note])
        group = self.title_at(x, y)
        return DrawnKey("group", self.parts.group_keys[group]) if group >= 0 else None

    def touches(self, left: float, top: float, right: float, bottom: float) -> bool:
        """Whether a rectangle (scene units) touches a note or the title of a group."""
        if not self:
            return False
        bars = self.group_rects.copy()
        bars[:, 3] = bars[:, 1] + self.bar * self._sheet.unit
        rects = np.vstack([self.note_rects, bars])
        meets = (rects[:, :2] < (right, bottom)) & (rects[:, 2:] > (left, top))
        return bool(meets.all(axis=1).any())

    def around(self, states: list[int]) -> QRectF:
        """What the notes on these states and the groups with them cover."""
        if not self:
            return QRectF()
        parts = self.parts
        rects = [self.note_rects[np.isin(parts.states, states)]]
        rects += [
            self.group_rects[number : number + 1]
            for number, own in enumerate(self.members)
            if np.isin(own, states).any()
        ]
        hung = parts.states[np.isin(parts.states, states)]
        ends = self._sheet.at[hung]
        return _hull(np.vstack([*rects, np.hstack([ends, ends])]))

    def extent(self) -> QRectF:
        """What all notes and groups cover."""
        return _hull(np.vstack([self.note_rects, self.group_rects])) if self else QRectF()

    def tip(self, key: DrawnKey) -> str:
        """The tooltip: all words of a note that are not all drawn or too small, or of a group."""
        number = self.number(key)
        if key.kind == "note" and number >= 0:
            note = self.parts.notes[number]
            whole = self._sheet.zoom >= READABLE and not "".join(lines_of(note)[-1:]).endswith("…")
            by = ", ".join(part for part in (note.author, day_words(note.date)) if part)
            return "" if whole else "\n".join(part for part in (note.text, by) if part)
        return self.words(key)

    def words(self, key: DrawnKey) -> str:
        """A note or group in words, such as "Note: Ask the clinic, R. Stein, 12 Nov 2026"."""
        number, parts = self.number(key), self.parts
        if number < 0:
            return ""
        if key.kind == "note":
            note = parts.notes[number]
            on = f"on {note.state}" if note.state else ""
            said = (f"Note: {note.text}", by_words(note.author, note.date), on)
            return ", ".join(part for part in said if part)
        group = parts.groups[number]
        many = len(group.states)
        return f"Group {group.title}, {many} state{'' if many == 1 else 's'}"


def _rect(sides: Floats) -> QRectF:
    left, top, right, bottom = sides.tolist()
    return QRectF(left, top, right - left, bottom - top)


def _hull(rects: Floats) -> QRectF:
    if not len(rects):
        return QRectF()
    return _rect(np.concatenate([rects[:, :2].min(axis=0), rects[:, 2:].max(axis=0)]))


def _at(rects: Floats, x: float, y: float) -> int:
    """The number of the last rectangle with a point, -1 for none."""
    inside = ((rects[:, :2] <= (x, y)) & (rects[:, 2:] >= (x, y))).all(axis=1)
    found = np.nonzero(inside)[0]
    return int(found[-1]) if len(found) else -1
