"""A fact that the chosen node feeds: its value, and a line for each value with its condition."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QGridLayout, QVBoxLayout, QWidget

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.views.room_view import RoomFact
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Elided, Label, label, row
from smsl_studio.studio.base.notation_part import NotationPart
from smsl_studio.studio.base.small_button import SmallButton
from smsl_studio.studio.base.tag import Tag
from smsl_studio.studio.base.theme import Tokens

STAYS = "in between the last value stays"


class FactPart(QWidget):
    """One fact at a time, of those that a node feeds; the arrows show the others."""

    turned = Signal()
    """Another fact is shown."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._tokens = tokens
        self._facts: tuple[RoomFact, ...] = ()
        self._at = 0
        self.name, self.said = Elided(), Label(rich=True)
        self.name.setProperty("role", "strong")
        self.next = SmallButton("The next fact of this node", "chevron-right", tokens)
        self.next.clicked.connect(self._turn)
        self.why, self.needed = label("", "small"), label("", "small")
        self._rows = QGridLayout()
        self._rows.setHorizontalSpacing(8)
        self._rows.setVerticalSpacing(4)
        self._rows.setColumnStretch(1, 1)
        self._lines: list[tuple[Tag, Label]] = []
        self.notation = NotationPart()
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(6)
        top = row(self.name, self.said, self.next)
        top.setStretch(0, 1)
        column.addLayout(top)
        column.addWidget(self.why)
        column.addLayout(self._rows)
        column.addWidget(self.needed)
        column.addWidget(self.notation)
        for part in (self.why, self.needed):
            part.setWordWrap(True)

    @property
    def fact(self) -> RoomFact | None:
        """The fact that is shown."""
        return self._facts[self._at] if self._facts else None

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.next.set_tokens(tokens)
        for tag, _ in self._lines:
            tag.set_tokens(tokens)

    def show_facts(self, blueprint: Blueprint, facts: tuple[RoomFact, ...], wanted: str) -> None:
        """Show the fact with this key, else the one that was shown, else the first."""
        keys = [one.key for one in facts]
        before = self.fact.key if self.fact is not None else ""
        self._facts = facts
        self._at = next((keys.index(key) for key in (wanted, before) if key in keys), 0)
        self.setVisible(bool(facts))
        self._show(blueprint)

    def _show(self, blueprint: Blueprint) -> None:
        fact, tokens = self.fact, self._tokens
        if fact is None:
            return
        unknown = fact.value is None
        ink = (tokens.unk if unknown else tokens.ok).name()
        many = len(self._facts)
        self.name.setText(fact.name)
        said = "unknown" if unknown else f"reads {plain_text(fact.value or '')}"
        held = ", held back" if fact.held_back else ""
        count = f" &nbsp;{self._at + 1} of {many}" if many > 1 else ""
        self.said.setText(f'<b style="color:{ink}">{said}{held}</b>{count}')
        self.next.setVisible(many > 1)
        self.why.setText(fact.reason if unknown else "")
        self.why.setVisible(unknown)
        self._show_lines(fact)
        names = ", ".join(fact.needed_by)
        self.needed.setText(f"Needed by {names}" if names else "No operation requires it")
        self.notation.show_element(blueprint, fact.key)

    def _show_lines(self, fact: RoomFact) -> None:
        wanted = [(value, f"if {text}") for value, text in fact.predicates]
        wanted += [("?", STAYS)] if len(wanted) > 1 else []
        while len(self._lines) < len(wanted):
            tag, words = Tag(self._tokens), Label()
            words.setWordWrap(True)
            self._rows.addWidget(tag, len(self._lines), 0)
            self._rows.addWidget(words, len(self._lines), 1)
            self._lines.append((tag, words))
        for at, (tag, words) in enumerate(self._lines):
            shown = at < len(wanted)
            tag.setVisible(shown)
            words.setVisible(shown)
            if shown:
                value, text = wanted[at]
                tag.fit(value)
                tag.show_tag(value, "on" if value == fact.value else "value", False)
                words.setText(text)

    def _turn(self) -> None:
        self._at = (self._at + 1) % max(len(self._facts), 1)
        self.turned.emit()
