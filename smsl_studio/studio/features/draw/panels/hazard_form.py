"""The form of a file's hazards: facts that must never hold together."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from PySide6.QtWidgets import QPushButton, QVBoxLayout, QWidget

from smsl_studio.blueprint import editing
from smsl_studio.studio.base.controls import Field, label, row
from smsl_studio.studio.base.lines.fact_rows import FactRows
from smsl_studio.studio.base.lines.line import Sentence
from smsl_studio.studio.base.small_button import SmallButton
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.document.attempt import try_edit
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.panels.frame import Panel

MOST = 64
NONE = "None. A hazard names facts that must never hold together, in any configuration."


@dataclass
class HazardCard:
    """The widgets of one hazard.

    ``at`` is its index in ``_hazards``; -1 while it is not written.
    """

    at: int
    frame: QWidget
    name: Field
    facts: FactRows
    gone: SmallButton


class HazardForm(Panel):
    """Edits ``_hazards`` of the file that holds the SB that is shown."""

    def __init__(self, session: Session, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__("Hazards", parent)
        self._session, self._tokens = session, tokens
        self.cards: list[HazardCard] = []
        self.column.setContentsMargins(12, 8, 12, 12)
        self.column.setSpacing(6)
        self._count = label("", "count")
        self.add = QPushButton("Add")
        self.add.setProperty("role", "link")
        self.add.setToolTip("Add a hazard: a name, and facts that must never hold together")
        self.add.setAccessibleName("Add a hazard")
        self.add.clicked.connect(self._new)
        self.column.addLayout(row(label("Hazards", "heading"), self._count, None, self.add))
        self._none = label(NONE, "hint")
        self.column.addWidget(self._none)
        self._odd, self.refusal = Sentence("refusal"), Sentence("refusal")
        self._list = QVBoxLayout()
        self._list.setSpacing(10)
        self.column.addLayout(self._list)
        self.column.addWidget(self._odd)
        self.column.addWidget(self.refusal)
        session.blueprint_changed.connect(lambda *_: self.show_hazards())
        session.branch_changed.connect(lambda *_: self.show_hazards())
        self.show_hazards()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        for card in self.cards:
            card.facts.set_tokens(tokens)
            card.gone.set_tokens(tokens)

    def show_hazards(self) -> None:
        """Show the hazards as they are now, in cards."""
        written = self._written()
        fitting = [at for at, item in enumerate(written) if _fits(item)][:MOST]
        while len(self.cards) > len(fitting):
            card = self.cards.pop()
            self._list.removeWidget(card.frame)
            card.frame.hide()
            card.frame.deleteLater()
        while len(self.cards) < len(fitting):
            self.cards.append(self._card())
        for card, at in zip(self.cards, fitting, strict=True):
            card.at = at
            card.name.settle(written[at]["name"])
            card.facts.show_facts(self._session.blueprint, written[at]["facts"])
        odd = len(written) - len(fitting)
        self._odd.say(f"{odd} more that cannot be shown here. They are kept." if odd else "")
        self._count.setText(str(len(written)))
        self._count.setVisible(bool(written))
        self._none.setVisible(not written)
        self.refusal.say("")

    def reveal(self, name: str) -> None:
        """Give the keyboard focus to a hazard."""
        for card in self.cards:
            if card.name.text() == name:
                card.name.setFocus()
                return

    def _new(self) -> None:
        """Add a card. The hazard is written as soon as it has a name and a fact."""
        if not self.cards or self.cards[-1].at >= 0:
            card = self._card()
            card.facts.show_facts(self._session.blueprint, {})
            card.facts.add_row()
            self.cards.append(card)
            self._none.hide()
        self.cards[-1].name.setFocus()

    def _card(self) -> HazardCard:
        frame = QWidget()
        column = QVBoxLayout(frame)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(4)
        gone = SmallButton("Remove this hazard", "trash", self._tokens, 14)
        card = HazardCard(-1, frame, Field(), FactRows(self._tokens, "Add a fact"), gone)
        card.name.setPlaceholderText("Name of the hazard")
        card.name.setAccessibleName("Name of the hazard")
        card.name.setToolTip("What must not happen, in plain words")
        card.name.editingFinished.connect(lambda: self._named(card))
        card.facts.given.connect(lambda facts: self._changed(card, facts))
        gone.clicked.connect(lambda: self._remove(card))
        column.addLayout(row(card.name, gone, spacing=4))
        column.addWidget(card.facts)
        self._list.addWidget(frame)
        return card

    def _named(self, card: HazardCard) -> None:
        name = card.name.text().strip()
        if not card.name.changed or not name:
            return
        if card.at >= 0:
            old = self._written()[card.at]["name"]
            self._put(card, {"name": name}, f"Rename the hazard “{old}” to “{name}”")
        elif card.facts.facts:
            self._add(name, card.facts.facts)

    def _changed(self, card: HazardCard, facts: dict[str, str]) -> None:
        name = card.name.text().strip()
        if not facts:
            self.refusal.say("A hazard without facts says nothing. Remove it instead.")
        elif card.at >= 0:
            self._put(card, {"facts": facts}, f"Change the facts of the hazard “{name}”")
        else:
            card.facts.show_facts(self._session.blueprint, facts)
            if name:
                self._add(name, facts)
            else:
                card.name.setFocus()

    def _add(self, name: str, facts: Mapping[str, str]) -> None:
        hazard = {"name": name, "facts": dict(facts)}
        self._write([*self._written(), hazard], f"Add the hazard “{name}”")

    def _put(self, card: HazardCard, words: Mapping[str, Any], step: str) -> None:
        hazards = [dict(item) if _fits(item) else item for item in self._written()]
        hazards[card.at].update(words)
        self._write(hazards, step)

    def _remove(self, card: HazardCard) -> None:
        if card.at < 0:
            self.show_hazards()
            return
        hazards = self._written()
        gone = hazards.pop(card.at)
        self._write(hazards, f"Remove the hazard “{gone['name']}”")

    def _write(self, hazards: list[Any], step: str) -> None:
        file = self._session.blueprint.home(self._session.branch).file
        try_edit(
            self._session,
            step,
            lambda bp: editing.set_hazards(bp, hazards, file),
            self.refusal.say,
        )

    def _written(self) -> list[Any]:
        home = self._session.blueprint.home(self._session.branch)
        written = home.values.get("_hazards", [])
        return list(written) if isinstance(written, list) else []


def _fits(item: Any) -> bool:
    """Whether a value is a hazard: a name and facts, all of them texts."""
    if not isinstance(item, dict) or not isinstance(item.get("name"), str):
        return False
    facts = item.get("facts")
    return isinstance(facts, dict) and all(isinstance(value, str) for value in facts.values())
