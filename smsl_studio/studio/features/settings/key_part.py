"""The keys of the settings: a list of actions, and a field that takes another key for one."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHeaderView,
    QKeySequenceEdit,
    QPushButton,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.actions import Action, Actions, key_words
from smsl_studio.studio.base.controls import NameDelegate, label, name_parts, row
from smsl_studio.studio.base.current_cell import CurrentCell
from smsl_studio.studio.base.focus_line import FocusLine
from smsl_studio.studio.base.lines.line import Sentence
from smsl_studio.studio.base.own_keys import FIXED, objection
from smsl_studio.studio.base.words import BLANK

HINT = (
    "Choose an action, click into the field, and press its new key. Single letters on the canvas, "
    "and the keys of Stop (F8) and help (F1), stay as they are."
)
CHANGED = "{} does “{}” from now on."
HIGH = 220


class KeyPart(QWidget):
    """Shows the keys of all actions and changes those of one.

    ``give`` is called with the id of an action and its keys; None means the shipped ones.
    """

    def __init__(
        self, actions: Actions, give: Callable[[str, tuple[str, ...] | None], object]
    ) -> None:
        super().__init__()
        self._actions, self._give = actions, give
        self.rows: list[str] = []
        """The ids of the actions, row by row."""
        self.table = QTableWidget(0, 3)
        self.field = QKeySequenceEdit()
        self.refusal = Sentence("refusal")
        self.told = Sentence("hint")
        self.clear, self.shipped = QPushButton("No key"), QPushButton("As shipped")
        self._build()
        self._fill()

    def _build(self) -> None:
        table, heads = self.table, self.table.horizontalHeader()
        table.setProperty("role", "table")
        table.setAccessibleName("Keys")
        FocusLine(table)
        CurrentCell(table)
        table.setItemDelegate(NameDelegate(table))
        table.setHorizontalHeaderLabels(["Action", "Menu", "Key"])
        table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        table.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        table.setShowGrid(False)
        table.setTabKeyNavigation(False)
        table.setFixedHeight(HIGH)
        table.verticalHeader().hide()
        heads.setDefaultAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        heads.setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)
        name_parts(table)
        self.field.setMaximumSequenceLength(1)
        self.field.setAccessibleName("New key")
        self.field.setClearButtonEnabled(True)
        name_parts(self.field)
        for button in (self.clear, self.shipped):
            button.setAutoDefault(False)
            button.setProperty("role", "row")
        table.itemSelectionChanged.connect(self._chosen_changed)
        self.field.editingFinished.connect(self._take)
        self.clear.clicked.connect(lambda: self._put(()))
        self.shipped.clicked.connect(self._put_shipped)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(label(HINT, "hint"))
        column.addWidget(table)
        column.addLayout(row(label("New key", "second"), self.field, self.clear, self.shipped))
        column.addWidget(self.refusal)
        column.addWidget(self.told)

    def choose(self, name: str) -> None:
        """Choose the row of an action."""
        self.table.selectRow(self.rows.index(name))

    def _fill(self) -> None:
        shown = [action for action in self._actions if action.scope == "window" and action.menu]
        self.rows = [action.id for action in shown if action.id not in FIXED]
        self.table.setRowCount(len(self.rows))
        for at, name in enumerate(self.rows):
            action = self._actions.table[name]
            cells = (action.words.rstrip("…"), action.menu, _words(action))
            for column, words in enumerate(cells):
                item = QTableWidgetItem(plain_text(words))
                item.setData(Qt.ItemDataRole.AccessibleTextRole, plain_text(words) or BLANK)
                self.table.setItem(at, column, item)
        self._chosen_changed()

    @property
    def _chosen(self) -> Action | None:
        rows = self.table.selectionModel().selectedRows()
        return self._actions.table[self.rows[rows[0].row()]] if rows else None

    def _chosen_changed(self) -> None:
        chosen = self._chosen
        self.refusal.say("")
        self.field.setEnabled(chosen is not None)
        self.field.clear()
        self.clear.setEnabled(chosen is not None and bool(chosen.keys))
        shipped = self._actions.shipped[chosen.id].keys if chosen is not None else ()
        self.shipped.setEnabled(chosen is not None and chosen.keys != shipped)

    def _take(self) -> None:
        """Take the key that was pressed, or say why the action cannot have it."""
        chosen, keys = self._chosen, self.field.keySequence()
        key = keys.toString(QKeySequence.SequenceFormat.PortableText)
        if chosen is None or not key:
            return
        refused = objection(self._actions, chosen, key)
        if refused:
            self.field.clear()
            self.told.say("")
            self.refusal.say(refused)
        else:
            self._put((key,))

    def _put_shipped(self) -> None:
        """Give the chosen action its shipped keys back, if no other action has one of them."""
        chosen = self._chosen
        if chosen is None:
            return
        keys = self._actions.shipped[chosen.id].keys
        refused = next(
            (said for key in keys if (said := objection(self._actions, chosen, key))), ""
        )
        if refused:
            self.refusal.say(refused)
        else:
            self._put(None)

    def _put(self, keys: tuple[str, ...] | None) -> None:
        chosen = self._chosen
        if chosen is None:
            return
        self._give(chosen.id, keys)
        now = self._actions.table[chosen.id]
        cell = self.table.item(self.rows.index(chosen.id), 2)
        if cell is not None:
            cell.setText(plain_text(_words(now)))
            cell.setData(Qt.ItemDataRole.AccessibleTextRole, plain_text(_words(now)) or BLANK)
        self._chosen_changed()
        words = now.words.rstrip("…")
        self.told.say(CHANGED.format(_words(now) or "No key", words))


def _words(action: Action) -> str:
    return " or ".join(key_words(key) for key in action.keys)
