"""The header of the SB that is shown: INITIAL, ACTIVATING, NUM_FACTS, a sub-SB for each fact."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from PySide6.QtWidgets import QGridLayout, QLabel, QWidget

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.names import fresh_branch_name
from smsl_studio.studio.chips import VALUE
from smsl_studio.studio.controls import Combo, Field, label, row
from smsl_studio.studio.panels.frame import Panel
from smsl_studio.studio.panels.note_edits import Spot, set_note_value
from smsl_studio.studio.panels.state_form import labelled
from smsl_studio.studio.panels.tag import Tag
from smsl_studio.studio.panels.trying import try_edit
from smsl_studio.studio.session import Session
from smsl_studio.studio.theme import CONTROL_ROW, Tokens, text_font
from smsl_studio.studio.words import counted

MOST = 64
"""So many facts have a row; a slip in NUM_FACTS must not fill the window with thousands."""
NEW = ""
"""In place of a name in the list of sub-SBs: one that is made for it."""


@dataclass
class FactRow:
    """The widgets of one fact."""

    chip: Tag
    name: Field
    sub: Combo


class HeaderForm(Panel):
    """Each change is one undoable edit; what is refused is said beside the field."""

    def __init__(self, session: Session, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__("Branch header", parent)
        self._session, self._tokens = session, tokens
        self._rows: list[FactRow] = []
        self._states: tuple[str, ...] | None = None
        self.column.setContentsMargins(12, 8, 12, 16)
        self.column.setSpacing(6)
        self._branch_name = label("", "second")
        self.column.addLayout(row(label("Branch header", "heading"), self._branch_name, None))
        self.initial = self._choice("Initial", "INITIAL", "The state the SB starts in")
        self.activating = self._choice(
            "Activating", "ACTIVATING", "The state in which the SB turns its base's fact on"
        )
        self.num_facts = Field()
        self.num_facts.setAccessibleName("Number of facts")
        self.num_facts.setToolTip("NUM_FACTS: how many facts a state's name carries")
        self.num_facts.editingFinished.connect(self._set_num_facts)
        self.column.addLayout(labelled("Facts", self.num_facts))
        self.refusal: QLabel = label("", "refusal")
        self.refusal.hide()
        self.column.addWidget(self.refusal)
        self._grid = QGridLayout()
        self._grid.setContentsMargins(0, 8, 0, 0)
        self._grid.setHorizontalSpacing(6)
        self._grid.setVerticalSpacing(8)
        self._grid.setColumnStretch(1, 1)
        self._titles = label("Fact", "small"), label("Sub-SB", "small")
        self._grid.addWidget(self._titles[0], 0, 0, 1, 2)
        self._grid.addWidget(self._titles[1], 0, 2)
        self.column.addLayout(self._grid)
        self.sentence: QLabel = label("", "hint")
        self.column.addWidget(self.sentence)
        self.column.addStretch(1)
        session.blueprint_changed.connect(lambda *_: self.show_header())
        session.branch_changed.connect(self._another)
        self.show_header()

    def set_tokens(self, tokens: Tokens) -> None:
        self._tokens = tokens
        for fact in self._rows:
            fact.chip.set_tokens(tokens)

    @property
    def facts(self) -> tuple[FactRow, ...]:
        """The rows of the facts, digit 0 first."""
        return tuple(self._rows)

    def show_header(self) -> None:
        """Show the header of the SB that is shown, as it is now."""
        blueprint, name = self._session.blueprint, self._session.branch
        self.setVisible(name in blueprint.branches)
        if name not in blueprint.branches:
            return
        branch = blueprint[name]
        self._branch_name.setText(name)
        self._show_states(branch)
        header = branch.header
        self.num_facts.settle("" if header.num_facts is None else str(header.num_facts))
        self.num_facts.setPlaceholderText(f"{branch.num_facts}" if branch.table else "none yet")
        self.num_facts.set_suffix(_width_words(branch))
        self._show_facts(blueprint, branch)
        self.sentence.setText(_explanation(blueprint, branch))
        self.sentence.setVisible(bool(self.sentence.text()))

    def _another(self, _: str) -> None:
        self._states = None
        self.refusal.hide()
        self.show_header()

    def _choice(self, words: str, key: str, tip: str) -> Combo:
        combo = Combo()
        combo.setAccessibleName(f"{words} state")
        combo.setToolTip(f"{key}: {tip}")
        combo.activated.connect(lambda at: self._set_state(key, combo, at))
        self.column.addLayout(labelled(words, combo))
        return combo

    def _show_states(self, branch: StateBranch) -> None:
        states = tuple(branch.table)
        same = states == self._states
        self._states = states
        for combo, written, default in (
            (self.initial, branch.header.initial, next(iter(states), "none yet")),
            (self.activating, branch.header.activating, next(reversed(states), "none yet")),
        ):
            first = f"Default ({default})"
            if not same:
                combo.clear()
                combo.addItems([first, *states])
            combo.setItemText(0, first)
            if written is not None and written not in branch.table:
                combo.setItemText(0, f"{written} (no such state)")
                combo.setCurrentIndex(0)
            else:
                combo.setCurrentIndex(0 if written is None else states.index(written) + 1)

    def _show_facts(self, blueprint: Blueprint, branch: StateBranch) -> None:
        count = min(_count(branch), MOST)
        while len(self._rows) > count:
            gone = self._rows.pop()
            for widget in (gone.chip, gone.name, gone.sub):
                self._grid.removeWidget(widget)
                widget.hide()
                widget.deleteLater()
        while len(self._rows) < count:
            self._rows.append(self._new_row(len(self._rows)))
        for title in self._titles:
            title.setVisible(count > 0)
        others = [name for name in blueprint.branches if name != branch.name]
        for digit, fact in enumerate(self._rows):
            sub = branch.subs.get(digit)
            fact.chip.show_tag(str(digit), VALUE, sub is not None)
            fact.name.settle(branch.fact_name(digit))
            fact.name.setToolTip(f"{branch.fact_name(digit)}. Type to name this fact.")
            fact.sub.accent = sub is not None
            fact.sub.setProperty("pale", sub is None)
            fact.sub.clear()
            names = [*others, sub] if sub and sub not in others else others
            fact.sub.addItem("None", None)
            for name in names:
                fact.sub.addItem(name, name)
            fact.sub.addItem("New", NEW)
            fact.sub.setCurrentIndex(names.index(sub) + 1 if sub else 0)
            fact.sub.setToolTip(f"Sub-SB of fact {digit}: {sub or 'none'}")
            fact.sub.update()

    def _new_row(self, digit: int) -> FactRow:
        fact = FactRow(Tag(self._tokens), Field(), Combo(height=28))
        fact.name.setProperty("role", "flat")
        fact.name.setAccessibleName(f"Name of fact {digit}")
        fact.name.editingFinished.connect(lambda: self._set_name(digit))
        fact.sub.setAccessibleName(f"Sub-SB of fact {digit}")
        fact.sub.setFixedWidth(118)
        fact.sub.setFont(text_font(12))
        fact.sub.activated.connect(lambda at: self._set_sub(digit, at))
        for place, widget in enumerate((fact.chip, fact.name, fact.sub)):
            self._grid.addWidget(widget, digit + 1, place)
        self._grid.setRowMinimumHeight(digit + 1, CONTROL_ROW)
        return fact

    # Edits.

    def _set_state(self, key: str, combo: Combo, at: int) -> None:
        name, state = self._session.branch, combo.itemText(at) if at else None
        words = f"Set {key} to {state}" if state else f"Leave {key} to the default"
        self._try(words, lambda bp: editing.set_header(bp, name, key, state))

    def _set_num_facts(self) -> None:
        if not self.num_facts.changed:
            return
        name, text = self._session.branch, self.num_facts.text().strip()
        if text and not (text.isascii() and text.isdecimal()):
            self._refuse(f"NUM_FACTS is a whole number, and “{text}” is none. Write 1 or more.")
            return
        number = int(text) if text else None
        words = f"Set NUM_FACTS to {number}" if number is not None else "Leave NUM_FACTS out"
        done = self._try(words, lambda bp: editing.set_header(bp, name, "NUM_FACTS", number))
        self.num_facts.set_refused(not done)

    def _set_sub(self, digit: int, at: int) -> None:
        name, sub = self._session.branch, self._rows[digit].sub.itemData(at)
        before = self._session.blueprint[name].subs.get(digit)
        if sub == before:
            return
        new = sub == NEW
        if new:
            sub = fresh_branch_name(self._session.blueprint)

        def change(blueprint: Blueprint) -> Blueprint:
            if new:
                blueprint = editing.add_branch(blueprint, sub)
            if before is not None:
                blueprint = editing.detach_sub(blueprint, name, before)
            return editing.attach_sub(blueprint, name, digit, sub) if sub else blueprint

        words = f"Attach {sub} to fact {digit} of {name}" if sub else f"Detach {before}"
        self._try(words, change)

    def _set_name(self, digit: int) -> None:
        field, name = self._rows[digit].name, self._session.branch
        if field.changed:
            text = field.text().strip()
            text = "" if text == f"Fact {digit + 1}" else text
            self._try(
                f"Name fact {digit} “{text}”" if text else f"Leave fact {digit} without a name",
                lambda bp: set_note_value(
                    bp, Spot(name, "_facts", str(digit), "name"), text or None
                ),
            )

    def _try(self, words: str, change: Any) -> bool:
        done = try_edit(self._session, words, change, self.refusal)
        if not done:
            number, typed = self.num_facts.text(), self.num_facts.changed
            self.show_header()
            if typed:
                self.num_facts.setText(number)
        return done

    def _refuse(self, sentence: str) -> None:
        self.refusal.setText(sentence)
        self.refusal.show()
        self.num_facts.set_refused(True)


def _count(branch: StateBranch) -> int:
    return branch.num_facts if branch.table else (branch.header.num_facts or 0)


def _width_words(branch: StateBranch) -> str:
    shape = branch.shape
    if not branch.table:
        return ""
    if shape.opaque:
        return "names are not cut"
    default = "default, " if branch.header.num_facts is None else ""
    if shape.width == 0:
        return f"{default}given in the text"
    return f"{default}{counted(shape.width, 'character')} each"


def _explanation(blueprint: Blueprint, branch: StateBranch) -> str:
    """What a sub-SB under a fact means, in a sentence for each."""
    said = [f"The first {MOST} of {_count(branch):,} facts."] if _count(branch) > MOST else []
    for digit, sub in branch.subs.items():
        if sub in blueprint.branches:
            state = blueprint[sub].activating or "not drawn yet"
            said.append(
                f"“{branch.fact_name(digit)}” is on exactly while {sub} stands in its "
                f"activating state, {state}."
            )
        else:
            said.append(f"{sub} is no State Branch of this blueprint.")
    return "\n".join(said)
