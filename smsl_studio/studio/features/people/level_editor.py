"""The dialog Edit levels: who does, senses, inspects and supervises."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import (
    QDialog,
    QHBoxLayout,
    QLineEdit,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from smsl_studio.blueprint.continuum import AUTOMATIC, HUMAN, SHARED
from smsl_studio.blueprint.editing import set_levels
from smsl_studio.studio.base.controls import Switch, label
from smsl_studio.studio.base.lines.line import Sentence
from smsl_studio.studio.base.screens import open_at
from smsl_studio.studio.base.theme import CONTROL
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.document.attempt import try_edit
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.people.level_rows import level_rows
from smsl_studio.studio.features.people.level_table import OUT, LevelModel, LevelTable
from smsl_studio.studio.running.next_levels import NextLevels

ABOUT = (
    "Human: a person does it, says it, or lets it begin. Shared: a person confirms, or is asked "
    "where sensors do not know. Automatic: the library, sensors, rules or an agent alone."
)
CHOICES = (("Human", HUMAN), ("Shared", SHARED), ("Automatic", AUTOMATIC), ("As declared", ""))
USES = "They are part of the record of the run; the file stays as it is"
WRITES = "Taking out changes the file; for one run only, choose another level"
OUT_TIP = "Remove their entries from _levels; the rest of the blueprint then decides"
UNDO_KEYS, REDO_KEYS = ("Ctrl+Z",), ("Ctrl+Shift+Z", "Ctrl+Y")
NOT_WRITTEN = "No marked row has an entry in _levels of this file"


class LevelEditor(QDialog):
    """Sets levels for the next run only, or writes them into the blueprint as one step."""

    def __init__(self, session: Session, levels: NextLevels, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session, self._levels = session, levels
        self.setWindowTitle("Edit levels")
        open_at(self, 820, 560)
        self.model = LevelModel()
        self.model.chosen = dict(levels.set)
        self.table = LevelTable(self.model)
        self.search = QLineEdit()
        self.search.setPlaceholderText("Find, such as fact or Op_1b")
        self.search.setAccessibleName("Find")
        self.search.setFixedHeight(CONTROL)
        self.search.textChanged.connect(self.model.find)
        self.each = Switch()
        self.each.setAccessibleName("Each edge by itself")
        self.each.setToolTip("A row for every edge, not only where those of a name differ")
        self.each.toggled.connect(lambda _: self._fill())
        self.buttons: dict[str, QPushButton] = {}
        self._count = label("", "small")
        self.refusal = Sentence("refusal")
        column = QVBoxLayout(self)
        column.setContentsMargins(16, 16, 16, 16)
        column.setSpacing(10)
        column.addWidget(label(ABOUT, "hint"))
        column.addLayout(_across(self.search, self.each, label("Each edge by itself", "second")))
        column.addWidget(self.table, 1)
        column.addLayout(self._choosing())
        column.addWidget(self.refusal)
        column.addLayout(self._ending())
        self.table.marked.connect(self._refresh)
        self.model.dataChanged.connect(lambda *_: self._refresh())
        for keys, call in ((UNDO_KEYS, self.model.undo), (REDO_KEYS, self.model.redo)):
            for key in keys:
                QShortcut(QKeySequence(key), self).activated.connect(call)
        session.blueprint_changed.connect(self._blueprint_changed)
        self._fill()
        self.search.setFocus()

    def choose(self, level: str) -> None:
        """Choose a level for the marked rows; empty means as declared."""
        self.model.choose(self.table.keys(), level)

    def use(self) -> None:
        """Use the chosen levels for the next run, and close."""
        self._levels.put(self.model.chosen)
        self.accept()

    def write(self) -> None:
        """Write the chosen levels into the blueprint as one step, and close if that is accepted."""
        chosen = dict(self.model.chosen)
        words = counted(len(chosen), "level")
        entries = {key: None if level == OUT else level for key, level in chosen.items()}
        said = f"Take {words} out" if set(chosen.values()) == {OUT} else f"Set {words}"
        done = try_edit(self._session, said, lambda bp: set_levels(bp, entries), self.refusal.say)
        if done:
            self._levels.put({})
            self.accept()

    def _choosing(self) -> QHBoxLayout:
        across = _across(self._count, None)
        for words, level in CHOICES:
            button = QPushButton(words)
            button.setAutoDefault(False)
            button.setProperty("role", "row")
            button.clicked.connect(partial(self.choose, level))
            self.buttons[level] = button
            across.addWidget(button)
        self.out_button = QPushButton("Take out of the file")
        self.out_button.setAutoDefault(False)
        self.out_button.setProperty("role", "row")
        self.out_button.clicked.connect(self._take_out)
        across.addWidget(self.out_button)
        return across

    def _take_out(self) -> None:
        """Choose that the file's entries for the marked rows are removed."""
        self.model.choose(self._written(), OUT)

    def _written(self) -> list[str]:
        """The keys of the marked rows that have an entry in ``_levels`` of this file."""
        own = self._session.blueprint.document.values.get("_levels", {})
        marked = self.table.keys()
        return [key for key in marked if isinstance(own, dict) and key in own]

    def _ending(self) -> QHBoxLayout:
        self.write_button = QPushButton("Write into the blueprint")
        self.write_button.setToolTip("As _levels of the file; Undo takes it back")
        self.use_button = QPushButton("Use for the next run")
        self.use_button.setProperty("role", "primary")
        leave = QPushButton("Leave as it was")
        for button, call in (
            (leave, self.reject),
            (self.write_button, self.write),
            (self.use_button, self.use),
        ):
            button.setAutoDefault(False)
            button.clicked.connect(call)
        return _across(None, leave, self.write_button, self.use_button)

    def _fill(self) -> None:
        self.model.show_rows(level_rows(self._session.blueprint, self.each.isChecked()))
        self._refresh()

    def _blueprint_changed(self) -> None:
        if self.isVisible():
            self._fill()

    def _refresh(self) -> None:
        marked = len(self.table.keys())
        self._count.setText(f"{counted(marked, 'row')} marked:" if marked else "Mark rows to set")
        for button in self.buttons.values():
            button.setEnabled(marked > 0)
        self.out_button.setEnabled(bool(self._written()))
        self.out_button.setToolTip(tip_text(OUT_TIP if self._written() else NOT_WRITTEN))
        self.write_button.setEnabled(bool(self.model.chosen))
        same = self.model.chosen == dict(self._levels.set)
        taken = OUT in self.model.chosen.values()
        self.use_button.setEnabled(not same and not taken)
        self.use_button.setToolTip(tip_text(WRITES if taken else USES))


def _across(*parts: QWidget | None) -> QHBoxLayout:
    layout = QHBoxLayout()
    layout.setSpacing(8)
    for part in parts:
        if part is None:
            layout.addStretch(1)
        else:
            layout.addWidget(part, 1 if isinstance(part, QLineEdit) else 0)
    layout.setAlignment(Qt.AlignmentFlag.AlignVCenter)
    return layout
