"""The form of an SB's header: INITIAL, ACTIVATING, NUM_FACTS, NUM_STATES and the sub-SBs."""

from __future__ import annotations

import os
from collections.abc import Callable
from itertools import islice
from typing import Any

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QLabel, QWidget

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.names import fresh_branch_name
from smsl_studio.blueprint.plain_words import told_facts
from smsl_studio.legible import plain_text
from smsl_studio.smsl.document.stretches import Stretch, differing_stretch
from smsl_studio.studio.base.controls import Combo, Elided, label, row
from smsl_studio.studio.base.lines.line import FormLine, Sentence, ShownValue
from smsl_studio.studio.base.lines.text import NumberBounds, NumberLine
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import counted, first_lines
from smsl_studio.studio.document.attempt import try_edit
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.panels.fact_form import expansion
from smsl_studio.studio.features.draw.panels.fact_name import fact_name_step
from smsl_studio.studio.features.draw.panels.frame import Panel
from smsl_studio.studio.features.draw.panels.header_facts import (
    MOST,
    NEW,
    HeaderFactRow,
    HeaderFacts,
)
from smsl_studio.studio.features.draw.panels.kept import KeptValues, kept_fields

KNOWN = ("_facts", "_states", "_operations", "_layout", "_notes")
SENTENCES = 24
"""At most this many sub-SBs are explained in a sentence."""


class HeaderForm(Panel):
    """Edits the header of the SB that is shown.

    Each change is one undoable edit. A refusal is shown at the field.
    """

    fact_wanted = Signal(str, int)
    """(SB, digit): the person clicked the chip of this fact."""

    def __init__(self, session: Session, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__("Branch header", parent)
        self._session = session
        self._states: tuple[str, ...] = ()
        self.column.setContentsMargins(12, 8, 12, 12)
        self.column.setSpacing(6)
        self._branch_name = Elided()
        self._branch_name.setProperty("role", "second")
        self.column.addLayout(row(label("Branch header", "heading"), self._branch_name))
        self.home: QLabel = label("", "hint")
        self.column.addWidget(self.home)
        self.initial = self._choice("Initial", "INITIAL", "The state the SB starts in")
        self.activating = self._choice(
            "Activating", "ACTIVATING", "The state in which the SB turns its base's fact on"
        )
        self.facts_line = NumberLine(
            "Facts", "NUM_FACTS: how many facts a state's name carries", NumberBounds(1, whole=True)
        )
        self.states_line = NumberLine(
            "States", "NUM_STATES: if it is written, it must be the number of states",
            NumberBounds(0, whole=True),
        )  # fmt: skip
        for key, line in (("NUM_FACTS", self.facts_line), ("NUM_STATES", self.states_line)):
            line.given.connect(self._giver(key, line))
            self.column.addWidget(line)
        self.num_facts, self.num_states = self.facts_line.field, self.states_line.field
        self.refusal = Sentence("refusal")
        self.column.addWidget(self.refusal)
        self._facts = HeaderFacts(tokens, self.num_states)
        self._facts.named.connect(self._set_name)
        self._facts.sub_chosen.connect(self._set_sub)
        self._facts.wanted.connect(lambda at: self.fact_wanted.emit(self._session.branch, at))
        self.column.addWidget(self._facts)
        self.sentence: QLabel = label("", "hint")
        self.column.addWidget(self.sentence)
        self.kept = KeptValues("Kept in this State Branch")
        self.column.addWidget(self.kept)
        session.afterwards.follow(self.show_header, session.blueprint_changed)
        session.branch_changed.connect(self._another)
        self.show_header()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._facts.set_tokens(tokens)

    @property
    def facts(self) -> tuple[HeaderFactRow, ...]:
        """The rows of the facts, digit 0 first."""
        return tuple(self._facts.rows)

    def show_header(self) -> None:
        """Show the header of the SB that is shown, as it is now."""
        blueprint, name = self._session.blueprint, self._session.branch
        self.setVisible(name in blueprint.branches)
        if name not in blueprint.branches:
            return
        branch = blueprint[name]
        self._branch_name.setText(name)
        self._show_home(blueprint, name)
        self._show_states(branch)
        header = branch.header
        self.facts_line.show_values([ShownValue(header.num_facts)])
        self.num_facts.setPlaceholderText(f"{branch.num_facts}" if branch.table else "none yet")
        self.num_facts.set_suffix(_width_words(branch))
        self.states_line.show_values([ShownValue(header.num_states)])
        self.num_states.setPlaceholderText(f"not written ({len(branch.table):,})")
        self._facts.show_facts(blueprint, branch)
        self.sentence.setText(_explanation(blueprint, branch))
        self.sentence.setVisible(bool(self.sentence.text()))
        self.kept.show_values(
            {**header.unknown, **header.odd, **header.fields, **kept_fields(branch.fields, KNOWN)}
        )

    def _show_home(self, blueprint: Blueprint, name: str) -> None:
        """Show the file that holds the SB, if there are several files."""
        home = blueprint.home(name).file
        self.home.setVisible(len(blueprint.documents) > 1)
        self.home.setText(f"In {os.path.basename(home)}. Edits go there.")  # noqa: PTH119
        self.home.setToolTip(tip_text(home))

    def _another(self, _: str) -> None:
        self.refusal.say("")
        self.show_header()

    def _choice(self, words: str, key: str, tip: str) -> Combo:
        combo = Combo()
        self.column.addWidget(FormLine(words, combo, f"{key}: {tip}"))
        combo.setAccessibleName(plain_text(f"{words} state"))
        combo.activated.connect(lambda at: self._set_state(key, combo, at))
        return combo

    def _show_states(self, branch: StateBranch) -> None:
        states = tuple(branch.table)
        same = states == self._states
        gone = Stretch(0, 0, 0, 0) if same else differing_stretch(self._states, states)
        self._states = states
        for combo, written, default in (
            (self.initial, branch.header.initial, next(iter(states), "none yet")),
            (self.activating, branch.header.activating, next(reversed(states), "none yet")),
        ):
            first = f"Default ({default})"
            # The first choice is none of the states. There may be thousands, of which few change.
            if not combo.count():
                combo.addItem(first)
            combo.model().removeRows(gone.begin + 1, gone.end - gone.begin)
            combo.insertItems(gone.begin + 1, states[gone.first : gone.last])
            if combo.itemText(0) != first:
                combo.setItemText(0, first)
            if written is not None and written not in branch.table:
                combo.setItemText(0, f"{written} (no such state)")
                combo.setCurrentIndex(0)
            else:
                combo.setCurrentIndex(0 if written is None else states.index(written) + 1)

    # Edits.

    def _set_state(self, key: str, combo: Combo, at: int) -> None:
        name, state = self._session.branch, combo.itemText(at) if at else None
        words = f"Set {key} to {state}" if state else f"Leave {key} to the default"
        self._try(words, lambda bp: editing.set_header(bp, name, key, state), self.refusal.say)

    def _giver(self, key: str, line: NumberLine) -> Callable[[Any], None]:
        def give(number: int | None) -> None:
            """Set the number, or leave the key out for None."""
            name = self._session.branch
            words = f"Set {key} to {number}" if number is not None else f"Leave {key} out"
            self._try(words, lambda bp: editing.set_header(bp, name, key, number), line.refuse)

        return give

    def _set_sub(self, digit: int, sub: str | None) -> None:
        name = self._session.branch
        before = self._session.blueprint[name].subs.get(digit)
        if sub == before:
            return
        new = sub == NEW
        made = fresh_branch_name(self._session.blueprint) if new else sub

        def change(blueprint: Blueprint) -> Blueprint:
            """The blueprint with the other sub-SB (or none) at the fact.

            A new SB is added first.
            """
            if new and made:
                blueprint = editing.add_branch(blueprint, made)
            if before is not None:
                blueprint = editing.detach_sub(blueprint, name, before)
            return editing.attach_sub(blueprint, name, digit, made) if made else blueprint

        words = f"Attach {made} to digit {digit} of {name}" if made else f"Detach {before}"
        if not self._try(words, change, self.refusal.say):
            self._facts.show_facts(self._session.blueprint, self._session.blueprint[name])

    def _set_name(self, digit: int, text: str) -> None:
        words, step = fact_name_step(self._session.branch, digit, text)
        self._try(words, step, self.refusal.say)

    def _try(
        self,
        words: str,
        change: Callable[[Blueprint], Blueprint],
        refuse: Callable[[str], None],
    ) -> bool:
        return try_edit(self._session, words, change, refuse)


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
    """A sentence for each of the first sub-SBs: when it turns its fact on."""
    count = told_facts(branch)
    said = [f"The first {MOST} of {count:,} facts."] if count > MOST else []
    subs = islice(branch.subs.items(), SENTENCES)
    told = [expansion(blueprint, branch, digit, sub) for digit, sub in subs]
    return "\n".join([*said, first_lines(told, SENTENCES, len(branch.subs))]).strip()
