"""The section Layout of a state: its place, and the notes that hang on it."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QPushButton, QVBoxLayout, QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.picture.drawn_parts import lines_of
from smsl_studio.studio.base.controls import Elided, label, row
from smsl_studio.studio.base.lines.line import labelled
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.features.draw.panels.place_line import PlaceLine, Places


class StateNotes(QWidget):
    """Says where a state stands and which note hangs on it. Adds the first note or shows it."""

    note_wanted = Signal(object, str)
    """(Address of the state, key): show this note; add one if the key is empty."""

    def __init__(self) -> None:
        super().__init__()
        self._state, self._key = Address(""), ""
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 6, 0, 0)
        column.addLayout(
            row(label("Layout", "heading"), label("never changes the meaning", "small"), None)
        )
        self.place = PlaceLine()
        column.addWidget(self.place)
        self.words = Elided("")
        self.button = QPushButton("Add note")
        self.button.clicked.connect(lambda: self.note_wanted.emit(self._state, self._key))
        inner = QWidget()
        line = row(self.words, self.button)
        line.setContentsMargins(0, 0, 0, 0)
        inner.setLayout(line)
        column.addLayout(labelled("Note", inner))

    def show_state(self, branch: StateBranch, state: str, places: Places) -> None:
        """Show the place and the notes of a state. ``places`` has those of all states."""
        self.place.show_state(branch, state, places)
        keys: Sequence[str] = branch.drawn.notes_on(state)
        self._state, self._key = Address(branch.name, state), keys[0] if keys else ""
        words = "None"
        if keys:
            more = f" and {len(keys) - 1} more" if len(keys) > 1 else ""
            words = " ".join(lines_of(branch.drawn.notes[keys[0]])) + more
        self.words.setText(words)
        self.words.setToolTip(tip_text(words if keys else ""))
        self.button.setText("Show note" if keys else "Add note")
        tip = "Select the note and scroll to it" if keys else "Put a note on this state"
        self.button.setToolTip(tip_text(f"{tip} (Ctrl+Shift+M adds one)"))
