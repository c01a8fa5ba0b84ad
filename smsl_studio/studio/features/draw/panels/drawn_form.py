"""The form of a note or a group: its words, who wrote it and when, or which states it has."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from PySide6.QtCore import QModelIndex, Qt, Signal
from PySide6.QtWidgets import QPushButton, QWidget

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.annotations import LONGEST, DrawnNote, Group
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.studio.base.canvas.drawn_sheet import DrawnKey
from smsl_studio.studio.base.controls import Elided, label, row
from smsl_studio.studio.base.lines.box import BoxLine
from smsl_studio.studio.base.lines.line import FormLine, ShownValue
from smsl_studio.studio.base.lines.text import TextLine
from smsl_studio.studio.base.rows import ListRow, RowsView
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.document.attempt import try_edit
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.panels.frame import Panel

MOST_ROWS = 12
"""The list of states is so many rows high at most."""
ROW = 28


class DrawnForm(Panel):
    """Edits one note or one group of the SB that is shown. A click on a state selects it."""

    verb_wanted = Signal(str)
    """The id of a window action: hang_note, free_note, ungroup."""

    def __init__(self, session: Session, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__("Note or group", parent)
        self._session, self._key = session, DrawnKey("note", "")
        self.column.setContentsMargins(12, 8, 12, 12)
        self.column.setSpacing(6)
        self._heading = label("Note", "heading")
        words = label("never changes the meaning", "second")
        self.column.addLayout(row(self._heading, words, None))
        self.text = self._add(BoxLine("Text", "What the note says", LONGEST), "text")
        self.author = self._add(TextLine("Author", "Who wrote the note", "nobody named"), "author")
        self.date, self.on = Elided(), Elided()
        self._date = FormLine("Date", self.date, "The day on which it was written")
        self._free = self._button("Free", "free_note", "Let the note hang on no state")
        self._hang = self._button("Hang", "hang_note", "Let the note move with the nearest state")
        tip = "The state with which the note moves"
        self._on = FormLine("Moves with", self.on, tip, self._hang, self._free)
        self.title = self._add(TextLine("Title", "The title of the frame", "none"), "title")
        self._count = label("", "count")
        dissolve = self._button("Dissolve", "ungroup", "Take the frame away; the states stay")
        self._states = QWidget()
        self._states.setLayout(row(label("States", "heading"), self._count, None, dissolve))
        self.states = RowsView(tokens, self, margin=0)
        self.states.setAccessibleName("States of the group")
        self.states.clicked.connect(self._clicked)
        self.states.activated.connect(self._clicked)
        for widget in (self._date, self._on, self._states, self.states):
            self.column.addWidget(widget)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.states.set_tokens(tokens)

    def show_drawn(self, branch: StateBranch, key: DrawnKey) -> bool:
        """Show a note or a group of an SB; returns whether it is there."""
        drawn = branch.drawn
        note, group = drawn.notes.get(key.key), drawn.groups.get(key.key)
        is_note = key.kind == "note"
        if (note if is_note else group) is None:
            return False
        self._key = key
        self._heading.setText("Note" if is_note else "Group")
        for widget in (self.text, self.author, self._date, self._on):
            widget.setVisible(is_note)
        for widget in (self.title, self._states, self.states):
            widget.setVisible(not is_note)
        if is_note and note is not None:
            self._show_note(note)
        elif group is not None:
            self._show_group(branch, group)
        return True

    def _show_note(self, note: DrawnNote) -> None:
        self.text.show_values([ShownValue(note.text)])
        self.author.show_values([ShownValue(note.author or None)])
        self.date.setText(note.date or "Not set")
        self.on.setText(note.state or "None, it is free")
        self._free.setVisible(bool(note.state))
        self._hang.setVisible(not note.state)

    def _show_group(self, branch: StateBranch, group: Group) -> None:
        self.title.show_values([ShownValue(group.title or None)])
        self._count.setText(f"{len(group.states):,}")
        rows = [ListRow(name, Address(branch.name, name), tip=name) for name in group.states]
        self.states.show_rows(rows)
        self.states.clearSelection()
        self.states.setFixedHeight(ROW * min(len(rows), MOST_ROWS))

    def _add(self, line: Any, word: str) -> Any:
        line.given.connect(lambda value: self._give(line, word, value))
        self.column.addWidget(line)
        return line

    def _button(self, words: str, verb: str, tip: str) -> QPushButton:
        button = QPushButton(words)
        button.setToolTip(tip)
        button.clicked.connect(lambda: self.verb_wanted.emit(verb))
        return button

    def _give(self, line: FormLine, word: str, value: str | None) -> None:
        """Write a word of the note or the group, as one step. A note without words is refused."""
        if word == "text" and value is None:
            line.refuse("A note needs words. Del deletes the note that is selected on the canvas.")
            return
        branch, key = self._session.branch, self._key
        change: Mapping[str, Mapping[str, Any]] = {key.key: {word: value}}
        put = editing.put_notes if key.kind == "note" else editing.put_groups
        what = {"text": "Edit a note", "author": "Set the author of a note"}
        step = what.get(word, f"Rename the group to {value or 'nothing'}")
        try_edit(self._session, step, lambda bp: put(bp, branch, change), line.refuse)

    def _clicked(self, index: QModelIndex) -> None:
        row_ = index.data(Qt.ItemDataRole.UserRole)
        self._session.select((row_.payload,))
