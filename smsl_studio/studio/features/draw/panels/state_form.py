"""The form of states: name, title, note, facts, whether it is safe, and its operations."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from PySide6.QtCore import QModelIndex, QPoint, Qt, Signal
from PySide6.QtWidgets import QWidget

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.annotations import StateNote
from smsl_studio.blueprint.facts import fact_string
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.plain_words import is_read_by_letters, told_facts
from smsl_studio.picture.sub_marks import sub_mark
from smsl_studio.studio.base.chips import Chips
from smsl_studio.studio.base.controls import label, row
from smsl_studio.studio.base.lines.box import BoxLine
from smsl_studio.studio.base.lines.choice import SwitchLine
from smsl_studio.studio.base.lines.line import ShownValue, labelled
from smsl_studio.studio.base.lines.text import ListLine, TextLine
from smsl_studio.studio.base.notation_part import NotationPart
from smsl_studio.studio.base.rows import ListRow, RowsView
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.panels.kept import KeptValues
from smsl_studio.studio.features.draw.panels.note_form import (
    NoteEntry,
    NoteForm,
    misfits_of,
    written_words,
)
from smsl_studio.studio.features.draw.panels.state_notes import StateNotes

MOST_ROWS = 12
PLAIN = StateNote()


class StateForm(NoteForm):
    """Edits one state, or what several share. A click on an operation selects it."""

    values_wanted = Signal(int, QPoint)
    """(digit, point of the screen): the person clicked this fact of the states."""

    def __init__(self, session: Session, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__("State", "_states", session, parent)
        self._states: tuple[Address, ...] = ()
        self._heading = label("State", "heading")
        self._name = label("", "second")
        self.column.addLayout(row(self._heading, self._name, None))
        tip = "The state's name; everything that names it follows (F2)"
        self.naming = TextLine("Name", tip)
        self.naming.given.connect(self._rename)
        self.column.addWidget(self.naming)
        self.name = self.naming.field
        self.title = self.add("title", TextLine("Title", "A plain title, for people")).field
        self.chips = Chips(tokens)
        self.chips.chosen.connect(self._want_fact)
        self._facts = QWidget()
        self._facts.setLayout(labelled("Facts", self.chips))
        self.column.addWidget(self._facts)
        self.values = self.add("facts", ListLine(
            "Fact values", "The value of each fact, digit 0 first, with commas between. "
            "Typed values count instead of those in the name", "such as 0, 1, 1",
            once=False)).field  # fmt: skip
        self.safe = self.add(
            "safe", SwitchLine("Safe state", "Whether the procedure may rest in this state")
        ).field
        self.note = self.add(
            "note", BoxLine("Description", "What people should know about this state")
        ).field
        self.column.addWidget(self.odd)
        self.kept = KeptValues("Kept in this state")
        self.column.addWidget(self.kept)
        self._count = label("", "count")
        self._to = label("to state", "small")
        self._out = QWidget()
        heading = row(label("Operations out", "heading"), self._count, None, self._to)
        heading.setContentsMargins(0, 6, 0, 0)
        self._out.setLayout(heading)
        self.column.addWidget(self._out)
        self.operations = RowsView(tokens, self, margin=0)
        self.operations.setAccessibleName("Operations out of this state")
        self.operations.clicked.connect(self._clicked)
        self.operations.activated.connect(self._clicked)
        self._none = label("None. Drag from the state's handle to draw one.", "hint")
        self.column.addWidget(self.operations)
        self.column.addWidget(self._none)
        self.notes = StateNotes()
        self.column.addWidget(self.notes)
        self.notation = NotationPart()
        self.column.addWidget(self.notation)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.chips.set_tokens(tokens)
        self.operations.set_tokens(tokens)

    def show_states(self, blueprint: Blueprint, states: Sequence[Address]) -> None:
        """Show one state as it is now, or what several share."""
        self._states = tuple(states)
        one = states[0] if len(states) == 1 else None
        self._heading.setText("State" if one else counted(len(states), "state"))
        self._name.setText(_short(one.state, 24) if one else "")
        self._name.setToolTip(tip_text(one.state if one else ""))
        source = self._source_of_facts(blueprint[one.branch], one.state) if one else ""
        self._lines["facts"].remark = source
        self.show_entries(_entries(blueprint, states))
        for widget in (self.naming, self._out, self.notes):
            widget.setVisible(one is not None)
        named = {at.branch for at in states}
        branch = blueprint[states[0].branch]
        self._facts.setVisible(len(named) == 1 and told_facts(branch) > 0)
        if len(named) == 1:
            self.chips.show_states(branch, [at.state for at in states])
        fields = blueprint[one.branch].state_fields.get(one.state, {}) if one else {}
        self.kept.show_values(fields)
        self.notation.show_element(blueprint, str(one or ""))
        if one is None:
            self._none.hide()
            self.operations.hide()
            return
        self.notes.show_state(branch, one.state, self._session.places.shown(branch))
        self.naming.show_values([ShownValue(one.state)])
        rows = [_operation_row(branch, one.state, name) for name in branch.table[one.state]]
        self._count.setText(str(len(rows)))
        self._to.setVisible(bool(rows))
        self._none.setVisible(not rows)
        self.operations.setVisible(bool(rows))
        self.operations.show_rows(rows)
        self.operations.clearSelection()
        self.operations.setFixedHeight(28 * min(len(rows), MOST_ROWS))

    def who(self) -> str:
        """The state or the number of states, in the words of an undo step."""
        states = self._states
        return states[0].state if len(states) == 1 else counted(len(states), "state")

    def give(self, word: str, value: Any) -> bool:
        """Write the value of a key. ``editing.give_values`` writes fact values."""
        if word != "facts" or value is None:
            return super().give(word, value)
        line = self._lines[word]
        wanted = _apart(list(value), self._session.blueprint[self._states[0].branch])

        def change(blueprint: Blueprint) -> Blueprint:
            """Return the blueprint in which the states have these facts."""
            for name in dict.fromkeys(at.branch for at in self._states):
                given = {at.state: wanted for at in self._states if at.branch == name}
                blueprint = editing.give_values(blueprint, name, given)
            return blueprint

        step = f"Set fact values of {self.who()} to {line.said(wanted)}"
        return self.edit(step, change, line.refuse)

    def _source_of_facts(self, branch: StateBranch, state: str) -> str:
        """A sentence that says where the fact values of a state come from."""
        shape, note = branch.shape, branch.state_note(state)
        given = note is not None and bool(note.facts)
        if shape.width == 0 and not shape.opaque:
            if self._session.unwritten.proposes(branch, state):
                return "Proposed for the new state. Type those that hold."
            return "Given here."
        if given:
            return "They count when every state has values."
        if shape.opaque:
            return "None: the name is its only fact."
        if not told_facts(branch):
            return "None yet. Type its values."
        if is_read_by_letters(branch, state):
            return "The letters of the name. Type its values."
        return "From the name."

    def _rename(self, new: Any) -> None:
        address, name = self._states[0], str(new or "")
        if name == address.state:
            return
        words = f"Rename {address.state} to {name}"
        if self.edit(words, lambda bp: editing.rename(bp, address, name), self.naming.refuse):
            self._session.select((Address(address.branch, name),))

    def _want_fact(self, digit: int) -> None:
        place = self.chips.place_of(digit).bottomLeft().toPoint()
        self.values_wanted.emit(digit, self.chips.mapToGlobal(place + QPoint(0, 6)))

    def _clicked(self, index: QModelIndex) -> None:
        row_ = index.data(Qt.ItemDataRole.UserRole)
        self._session.select((row_.payload,))


def _apart(values: list[str], branch: StateBranch) -> list[str]:
    """Values that were typed without commas, as names have them: 110 is 1, 1, 0 where each value
    of the other states is one letter."""
    together = len(values) == 1 and len(values[0]) == branch.num_facts > 1
    letters = together and all(len(one) == 1 for column in branch.alphabet for one in column)
    return list(values[0]) if letters else values


def _entries(blueprint: Blueprint, states: Sequence[Address]) -> list[NoteEntry]:
    odd = {name: misfits_of(blueprint[name], "_states") for name in {at.branch for at in states}}
    found = []
    for at in states:
        branch = blueprint[at.branch]
        misfits = odd[at.branch].get(at.state, {})
        written = written_words(branch, "_states", at.state) - set(misfits)
        note = branch.state_note(at.state) or PLAIN
        shape = branch.shape
        named = branch.facts(at.state) if shape.width and told_facts(branch) else ()
        standard = replace(PLAIN, facts=named) if named else PLAIN
        found.append(NoteEntry(at.branch, at.state, note, standard, written, misfits=misfits))
    return found


def _operation_row(branch: StateBranch, state: str, name: str) -> ListRow:
    target = branch.table[state][name]
    mark = sub_mark(branch, branch.operation(state, name))
    short = "itself" if target == state else _target_words(branch, target)
    title = branch.operation_note(state, name).title
    tip = f"{name} leads to {target}" + (f". {title}" if title else "")
    return ListRow(name, Address(branch.name, state, name), mark, "", short, tip=tip, accent=True,
               mono=True)  # fmt: skip


def _target_words(branch: StateBranch, target: str) -> str:
    if target not in branch.table:
        return f"{_short(target, 12)}?"
    shape = branch.shape
    text = target if shape.opaque else fact_string(target, shape.written)
    return _short(text, 14)


def _short(text: str, most: int) -> str:
    """The text; if it is longer than ``most`` characters, its middle is left out."""
    return text if len(text) <= most else f"{text[: most // 2]}…{text[-(most // 2 - 1) :]}"
