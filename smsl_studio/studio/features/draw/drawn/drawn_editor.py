"""DrawnEditor: gestures on notes and groups become edits of a session, one step each."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from datetime import datetime

from PySide6.QtCore import QObject, QPointF, Signal

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.annotations import DrawnNote
from smsl_studio.blueprint.drawn import NOTHING_DRAWN, Drawn
from smsl_studio.blueprint.editing.drawn import free_keys
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import StudioError
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.canvas.drawn_sheet import DrawnKey
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.canvas.free_places import place_near
from smsl_studio.studio.features.draw.canvas.name_field import NameField
from smsl_studio.studio.features.draw.canvas.nudge import PAUSE
from smsl_studio.studio.features.draw.drawn.note_field import NoteField
from smsl_studio.studio.features.draw.drawn.note_places import near, place_at, place_in_view

FIRST_RUN = 1_000_000
"""The runs of arrow keys count from here; those of states count from 1."""
WIDE_TITLE = 160


class DrawnEditor(QObject):
    """Selects, edits, moves and deletes the notes and groups of the SB that is shown.

    A note or group is selected instead of states and operations, never beside them. ``field`` is
    the field that is open, or None.
    """

    chosen_changed = Signal()

    def __init__(self, session: Session, canvas: Canvas) -> None:
        super().__init__(canvas)
        self._session, self._canvas = session, canvas
        self.author: Callable[[], str] = str
        """The name of the person who writes notes; empty for none."""
        self.today: Callable[[], str] = lambda: datetime.now().date().isoformat()
        self.clock: Callable[[], float] = time.monotonic
        self.field: NoteField | NameField | None = None
        self._last, self._run, self._nudged = -PAUSE, FIRST_RUN, DrawnKey("", "")
        self._refusals: list[StudioError] = []
        session.chosen_instead = lambda: self.chosen is not None
        session.refused.connect(self._refusals.append)
        session.blueprint_changed.connect(lambda *_: self._follow())
        session.opened.connect(self._close)
        session.branch_changed.connect(lambda _: self._leave())
        session.selection_changed.connect(self._selected)
        canvas.selection_wanted.connect(lambda _: self.choose(None))
        canvas.drawn_wanted.connect(self.choose)
        canvas.note_wanted.connect(self.add_note)
        canvas.drawn_edit_wanted.connect(self.edit)
        canvas.drawn_nudge_wanted.connect(self.nudge)
        canvas.note_moved.connect(self.move_note)
        canvas.delete_wanted.connect(self.delete)
        canvas.pressed.connect(self._settle)

    @property
    def chosen(self) -> DrawnKey | None:
        """The note or group that is selected; None for none."""
        return self._canvas.drawn.chosen

    @property
    def drawn(self) -> Drawn:
        """The notes and groups of the SB that is shown."""
        branch = self._session.blueprint.branches.get(self._session.branch)
        return branch.drawn if branch is not None else NOTHING_DRAWN

    def choose(self, key: DrawnKey | None) -> None:
        """Select a note or a group instead of states and operations; None selects none."""
        if key != self.chosen:
            if key is not None:
                self._session.give_way()
            self._canvas.choose_drawn(key)
            self.chosen_changed.emit()

    def show(self, key: DrawnKey, least: float = 0.0) -> None:
        """Select a note or a group, and scroll to it. A zoom below ``least`` rises to it."""
        self.choose(key)
        sheet, camera = self._canvas.sheet, self._canvas.camera
        rect = sheet.drawn.rect(key) if sheet is not None else None
        if rect is not None and not (self._canvas.seen.contains(rect) and not least):
            camera.finish()
            camera.keep("")
            camera.go(rect.center(), max(self._canvas.zoom, least))

    # Adding

    def add_note(self, at: QPointF | None = None, state: str = "") -> None:
        """Ask for the words of a new note: on a state, or free at a scene point. Without a point a
        free place in view is taken.
        """
        branch, canvas = self._session.branch, self._canvas
        if branch not in self._session.blueprint.branches:
            canvas.say("Add a state first, or a State Branch.")
            return
        hung: dict[str, object] = {"state": state} if state else {}
        if state:
            canvas.reveal(Address(branch, state), smooth=False)
            place = place_at(canvas, state)
            x, y = canvas.positions[state]
            corner = QPointF(x + place[0], y + place[1])
        else:
            place = near(at) if at is not None else place_in_view(canvas)
            corner = QPointF(*place)
        author, session = self.author(), self._session

        def commit(text: str) -> str:
            """Add the note and select it. Returns why that was refused, or the empty text."""
            if not text.strip() or branch not in session.blueprint.branches:
                return ""
            by = {"author": author} if author else {}
            words = {"text": text.rstrip(), **by, "date": self.today(), **hung, "at": place}
            key = next(free_keys(session.blueprint[branch].drawn.notes))
            reason = self._put_note("Add a note", key, words, branch=branch)
            if not reason and session.branch == branch:
                self.show(DrawnKey("note", key))
            return reason

        self._open(NoteField(canvas, canvas.tokens, "", commit), corner)

    def add_group(self) -> None:
        """Ask for the title of a group of the selected states."""
        branch, canvas = self._session.branch, self._canvas
        states = self.selected_states()
        if not states:
            canvas.say("Select the states of the group.")
            return

        def commit(title: str) -> str:
            """Add the group and select it. Returns why that was refused, or the empty text."""
            key = next(free_keys(self.drawn.groups))
            group = {"title": title, "states": states}
            words = f"Group {counted(len(states), 'state')}"
            reason = self._edit(words, lambda bp: editing.put_groups(bp, branch, {key: group}))
            if not reason:
                self.choose(DrawnKey("group", key))
            return reason

        canvas.reveal(Address(branch, states[0]), smooth=False)
        at = [canvas.positions[state] for state in states]
        middle = (min(x for x, _ in at) + max(x for x, _ in at)) / 2
        top = QPointF(middle, min(y for _, y in at) - 54.0)
        number = next(free_keys(self.drawn.groups))
        self._open(self._title_field(f"Group {number}", commit), top, centred=True)

    def put_copy(self, note: DrawnNote, at: tuple[float, float], state: str = "") -> None:
        """Add a copy of a note at a scene point, or so far from the centre of a state."""
        words = {"text": note.text, "author": note.author, "date": note.date}
        copied: dict[str, object] = {word: value for word, value in words.items() if value}
        hung = {"state": state} if state else {}
        key = next(free_keys(self.drawn.notes))
        self._put_note("Copy a note", key, {**copied, **hung, "at": at})

    # Editing

    def edit(self, key: DrawnKey) -> None:
        """Edit the words of a note, or the title of a group, on the canvas."""
        sheet, canvas = self._canvas.sheet, self._canvas
        if sheet is None or sheet.drawn.number(key) < 0:
            return
        self.show(key)
        canvas.camera.finish()
        rect = sheet.drawn.rect(key)
        assert rect is not None
        if key.kind == "note":
            text = self.drawn.notes[key.key].text
            commit = self._note_commit(key.key, text)
            self._open(NoteField(canvas, canvas.tokens, text, commit), rect.topLeft())
            return
        bar = sheet.drawn.title_rect(key)
        assert bar is not None
        title = self.drawn.groups[key.key].title
        commit = self._title_commit(key.key, title)
        self._open(self._title_field(title, commit), bar.center(), centred=True)

    def _note_commit(self, key: str, before: str) -> Callable[[str], str]:
        branch = self._session.branch

        def commit(text: str) -> str:
            """Change the note, or delete it if it has no words any more."""
            if text.rstrip() == before.rstrip():
                return ""
            if not text.strip():
                gone = {key: None}
                return self._edit("Delete a note", lambda bp: editing.put_notes(bp, branch, gone))
            return self._put_note("Edit a note", key, {"text": text.rstrip()}, branch=branch)

        return commit

    def _title_commit(self, key: str, before: str) -> Callable[[str], str]:
        branch = self._session.branch

        def commit(title: str) -> str:
            """Give the group another title."""
            if title == before:
                return ""
            change = {key: {"title": title}}
            words = f"Rename the group {before} to {title}"
            return self._edit(words, lambda bp: editing.put_groups(bp, branch, change))

        return commit

    def move_note(self, key: str, corner: QPointF, run: int = -1) -> None:
        """Move the upper left corner of a note to a scene point. It keeps its state."""
        note = self.drawn.notes[key]
        x, y = self._canvas.positions.get(note.state, (0.0, 0.0))
        self._put_note("Move a note", key, {"at": (corner.x() - x, corner.y() - y)}, run)

    def nudge(self, dx: float, dy: float) -> None:
        """Move the selected note, or the states of the selected group. Presses soon after each
        other are one step.
        """
        key, branch = self.chosen, self._session.branch
        if key is None:
            return
        if key != self._nudged or self.clock() - self._last >= PAUSE:
            self._run += 1
        if key.kind == "note":
            x, y = self.drawn.notes[key.key].at
            self._put_note("Move a note", key.key, {"at": (x + dx, y + dy)}, self._run)
        else:
            places, group = self._canvas.positions, self.drawn.groups[key.key]
            moved = {s: (places[s][0] + dx, places[s][1] + dy) for s in group.states}
            words, put = f"Move {counted(len(moved), 'state')}", self._session.places.moved
            self._edit(words, lambda bp: put(bp, branch, moved), self._run)
        self._nudged, self._last = key, self.clock()

    def hang(self, key: str, state: str) -> None:
        """Hang a note on a state, or free it with an empty name. It stays where it is."""
        sheet, places = self._canvas.sheet, self._canvas.positions
        assert sheet is not None
        rect = sheet.drawn.rect(DrawnKey("note", key))
        assert rect is not None
        x, y = places.get(state, (0.0, 0.0))
        words = f"Hang a note on {state}" if state else "Free a note"
        at = rect.left() - x, rect.top() - y
        self._put_note(words, key, {"at": at, "state": state or None})

    # Deleting

    def delete(self) -> None:
        """Delete the selected note, or dissolve the selected group."""
        key, branch = self.chosen, self._session.branch
        if key is not None and key.kind == "note":
            gone = {key.key: None}
            self._edit("Delete a note", lambda bp: editing.put_notes(bp, branch, gone))
        elif key is not None:
            self.dissolve([key.key])

    def dissolve(self, keys: Iterable[str]) -> None:
        """Dissolve groups. Their states stay."""
        branch, gone = self._session.branch, dict.fromkeys(keys)
        titles = ", ".join(self.drawn.groups[key].title for key in gone)
        words = f"Dissolve the group {titles}"
        self._edit(words, lambda bp: editing.put_groups(bp, branch, gone))

    # Inside

    def selected_states(self) -> list[str]:
        """The selected states of the SB that is shown."""
        branch, chosen = self._session.branch, self._session.selection
        return [a.state for a in chosen if a.branch == branch and a.state and not a.operation]

    def _put_note(
        self, words: str, key: str, note: dict[str, object], run: int = -1, branch: str = ""
    ) -> str:
        """Add or change a note, and select it. ``branch`` is its SB; without it, the shown SB."""
        at, change = branch or self._session.branch, {key: note}
        reason = self._edit(words, lambda bp: editing.put_notes(bp, at, change), run)
        if not reason and at == self._session.branch:
            self.choose(DrawnKey("note", key))
        return reason

    def _edit(self, words: str, change: Callable[[Blueprint], Blueprint], run: int = -1) -> str:
        """Edit the session. Returns why that was refused, or the empty text."""
        self._refusals.clear()
        if self._session.edit(words, change, run):
            return ""
        refusal = self._refusals[-1] if self._refusals else None
        return str(refusal.sentence).capitalize() if refusal is not None else "That is refused."

    def _follow(self) -> None:
        """After an edit or undo, unselect everything that no longer exists.

        A note that the person is writing stays open, because another program may have made the
        edit.
        """
        if not isinstance(self.field, NoteField):
            self._close()
        sheet = self._canvas.sheet
        if self.chosen is not None and (sheet is None or sheet.drawn.number(self.chosen) < 0):
            self.choose(None)

    def _leave(self) -> None:
        """Keep typed text in the SB where it was typed, because another SB is shown now."""
        self._settle()
        self._close()
        self.choose(None)

    def _selected(self, selection: tuple[Address, ...]) -> None:
        if selection or self._session.fact is not None:
            self.choose(None)

    def _title_field(self, title: str, commit: Callable[[str], str]) -> NameField:
        field = NameField(self._canvas, self._canvas.tokens, title, "Title of the group", commit)
        field.setMinimumWidth(WIDE_TITLE)
        return field

    def _open(self, field: NoteField | NameField, at: QPointF, centred: bool = False) -> None:
        self._close()
        self.field = field
        field.closed.connect(self._closed)
        field.adjustSize()
        point = self._canvas.mapFromScene(at)
        if centred:
            point.setX(point.x() - field.width() // 2)
            point.setY(point.y() - 18)
        place_near(field, self._canvas, point)
        field.show()
        field.raise_()
        field.field.setFocus()

    def _settle(self) -> None:
        """A press elsewhere on the canvas keeps what was typed."""
        if isinstance(self.field, NoteField):
            self.field.settle()

    def _close(self) -> None:
        if self.field is not None:
            self.field.close_field()

    def _closed(self) -> None:
        self.field = None
