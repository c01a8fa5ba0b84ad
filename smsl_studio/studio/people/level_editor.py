"""Edit levels: who does, senses, inspects and supervises, before a run begins."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QDialog,
    QHBoxLayout,
    QLineEdit,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from smsl_studio.blueprint.editing import set_levels
from smsl_studio.blueprint.levels import AUTOMATIC, HUMAN, SHARED
from smsl_studio.studio.controls import Switch, label
from smsl_studio.studio.panels.lines.line import Said
from smsl_studio.studio.panels.trying import try_edit
from smsl_studio.studio.people.level_rows import level_rows
from smsl_studio.studio.people.level_table import LevelModel, LevelTable
from smsl_studio.studio.people.next_levels import NextLevels
from smsl_studio.studio.session import Session
from smsl_studio.studio.theme import CONTROL
from smsl_studio.studio.words import counted

ABOUT = (
    "Human: a person does it, says it, or lets it begin. Shared: a person confirms, or is asked "
    "where sensors do not know. Automatic: the library, sensors, rules or an agent alone."
)
CHOICES = (("Human", HUMAN), ("Shared", SHARED), ("Automatic", AUTOMATIC), ("As declared", ""))


class LevelEditor(QDialog):
    """What is chosen counts for the next run, or is written into the blueprint as one step."""

    def __init__(self, session: Session, levels: NextLevels, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session, self._levels = session, levels
        self.setWindowTitle("Edit levels")
        self.resize(820, 560)
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
        self.refusal = Said("refusal")
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
        session.blueprint_changed.connect(self._blueprint_changed)
        self._fill()
        self.search.setFocus()

    def choose(self, level: str) -> None:
        """Give the marked rows a level."""
        self.model.choose(self.table.keys(), level)

    def use(self) -> None:
        """What is chosen holds for the next run."""
        self._levels.put(self.model.chosen)
        self.accept()

    def write(self) -> None:
        """What is chosen is written into the blueprint, as one step."""
        chosen = dict(self.model.chosen)
        words = counted(len(chosen), "level")
        done = try_edit(
            self._session, f"Set {words}", lambda bp: set_levels(bp, chosen), self.refusal.say
        )
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
        return across

    def _ending(self) -> QHBoxLayout:
        self.write_button = QPushButton("Write into the blueprint")
        self.write_button.setToolTip("As _levels of the file; Undo takes it back")
        self.use_button = QPushButton("Use for the next run")
        self.use_button.setProperty("role", "primary")
        self.use_button.setToolTip(
            "They are part of the record of the run; the file stays as it is"
        )
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
        self.write_button.setEnabled(bool(self.model.chosen))
        same = self.model.chosen == dict(self._levels.set)
        self.use_button.setEnabled(not same)


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
