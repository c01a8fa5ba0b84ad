"""The properties of one state: name, title, facts, whether it is safe, and where it leads."""

from __future__ import annotations

from PySide6.QtCore import QModelIndex, Qt
from PySide6.QtWidgets import QHBoxLayout, QLabel, QWidget

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.facts import fact_string
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.studio.chips import Chips
from smsl_studio.studio.controls import Field, Switch, label, row
from smsl_studio.studio.panels.frame import Panel
from smsl_studio.studio.panels.note_edits import Spot, set_note_value
from smsl_studio.studio.panels.trying import try_edit
from smsl_studio.studio.rows import Row, RowsView
from smsl_studio.studio.session import Session
from smsl_studio.picture.sub_marks import sub_mark
from smsl_studio.studio.theme import Tokens

LABEL, MOST_ROWS = 80, 12


class StateForm(Panel):
    """Edits one state; a click on an operation selects it."""

    def __init__(self, session: Session, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__("State", parent)
        self._session = session
        self._address = Address("")
        self.column.setContentsMargins(12, 8, 12, 12)
        self.column.setSpacing(6)
        self._name = label("", "second")
        self.column.addLayout(row(label("State", "heading"), self._name, None))
        self.name = self._field("Name", "The state's name; everything that names it follows (F2)")
        self.name.editingFinished.connect(self._rename)
        self.title = self._field("Title", "A plain title, for people")
        self.title.editingFinished.connect(self._retitle)
        self.chips = Chips(tokens)
        self.column.addLayout(labelled("Facts", self.chips))
        self.safe = Switch()
        self.safe.setAccessibleName("Safe state")
        self.safe.setToolTip("Whether the procedure may rest in this state")
        self.safe.clicked.connect(self._set_safe)
        self.safe_words = label("", "second")
        line = labelled("Safe state", self.safe)
        line.addSpacing(8)
        line.addWidget(self.safe_words)
        line.addStretch(1)
        self.column.addLayout(line)
        self.refusal: QLabel = label("", "refusal")
        self.refusal.hide()
        self.column.addWidget(self.refusal)
        self._count = label("", "count")
        self._to = label("to state", "small")
        heading = row(label("Operations out", "heading"), self._count, None, self._to)
        heading.setContentsMargins(0, 6, 0, 0)
        self.column.addLayout(heading)
        self.operations = RowsView(tokens, self, margin=0)
        self.operations.setAccessibleName("Operations out of this state")
        self.operations.clicked.connect(self._clicked)
        self.operations.activated.connect(self._clicked)
        self._none = label("None. Drag from the state's handle to draw one.", "hint")
        self.column.addWidget(self.operations)
        self.column.addWidget(self._none)

    def set_tokens(self, tokens: Tokens) -> None:
        self.chips.set_tokens(tokens)
        self.operations.set_tokens(tokens)

    def show_state(self, blueprint: Blueprint, address: Address) -> None:
        """Show one state as it is now."""
        if address != self._address:
            self.refusal.hide()
        self._address = address
        branch = blueprint[address.branch]
        note = branch.state_note(address.state)
        self._name.setText(_short(address.state, 24))
        self._name.setToolTip(address.state)
        self.name.settle(address.state)
        self.title.settle(note.title if note else "")
        self.chips.show_state(branch, address.state)
        safe = note.safe if note else None
        self.safe.setChecked(safe is True)
        self.safe_words.setText({True: "Yes", False: "No", None: "Not said"}[safe])
        rows = [_operation_row(branch, address.state, name) for name in branch.table[address.state]]
        self._count.setText(str(len(rows)))
        self._to.setVisible(bool(rows))
        self._none.setVisible(not rows)
        self.operations.setVisible(bool(rows))
        self.operations.show_rows(rows)
        self.operations.clearSelection()
        self.operations.setFixedHeight(28 * min(len(rows), MOST_ROWS))

    def _field(self, words: str, tip: str) -> Field:
        field = Field()
        field.setAccessibleName(f"{words} of the state")
        field.setToolTip(tip)
        self.column.addLayout(labelled(words, field))
        return field

    def _rename(self) -> None:
        address, new = self._address, self.name.text().strip()
        if not self.name.changed or not address.state:
            return
        done = try_edit(
            self._session,
            f"Rename {address.state} to {new}",
            lambda bp: editing.rename(bp, address, new),
            self.refusal,
        )
        self.name.set_refused(not done)
        if done:
            self._session.select((Address(address.branch, new),))

    def _retitle(self) -> None:
        if self.title.changed:
            text = self.title.text().strip()
            self._note(f"Title {self._address.state} “{text}”", "title", text or None)

    def _set_safe(self, on: bool) -> None:
        words = "safe" if on else "not safe"
        self._note(f"Mark {self._address.state} as {words}", "safe", on)

    def _note(self, words: str, name: str, value: object) -> None:
        at = self._address
        try_edit(
            self._session,
            words,
            lambda bp: set_note_value(bp, Spot(at.branch, "_states", at.state, name), value),
            self.refusal,
        )

    def _clicked(self, index: QModelIndex) -> None:
        row_ = index.data(Qt.ItemDataRole.UserRole)
        self._session.select((row_.payload,))


def labelled(words: str, field: QWidget) -> QHBoxLayout:
    """A field with its name at the left."""
    name = label(words, "label")
    name.setFixedWidth(LABEL)
    name.setBuddy(field)
    return row(name, field, spacing=0)


def _operation_row(branch: StateBranch, state: str, name: str) -> Row:
    target = branch.table[state][name]
    mark = sub_mark(branch, branch.operation(state, name))
    short = "itself" if target == state else _target_words(branch, target)
    title = branch.operation_note(state, name).title
    tip = f"{name} leads to {target}" + (f". {title}" if title else "")
    return Row(name, Address(branch.name, state, name), mark, "", short, tip=tip, accent=True,
               mono=True)  # fmt: skip


def _target_words(branch: StateBranch, target: str) -> str:
    if target not in branch.table:
        return f"{_short(target, 12)}?"
    shape = branch.shape
    text = target if shape.opaque else fact_string(target, shape.written)
    return _short(text, 14)


def _short(text: str, most: int) -> str:
    """The text, its middle left out where it is longer than ``most`` characters."""
    return text if len(text) <= most else f"{text[: most // 2]}…{text[-(most // 2 - 1) :]}"
