"""The line for the facts that an operation requires."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from PySide6.QtWidgets import QWidget

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.lines.fact_rows import FactRows
from smsl_studio.studio.base.lines.line import FormLine, ShownValue, same
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text


class RequiresLine(FormLine):
    """Rows of facts under a heading.

    If the entries differ, a row that is added replaces them all.
    """

    def __init__(self, words: str, tip: str, tokens: Tokens) -> None:
        super().__init__(words, QWidget(), tip)
        self.facts = FactRows(tokens, "Require a fact")
        self.facts.setToolTip(tip_text(tip))
        self.facts.setAccessibleName(plain_text(words))
        self._blueprint: Blueprint | None = None
        column = self.layout()
        assert column is not None
        column.addWidget(self.facts)
        self.facts.given.connect(lambda facts: self.given.emit(facts or None))

    def set_blueprint(self, blueprint: Blueprint) -> None:
        """Set the blueprint whose facts can be named."""
        self._blueprint = blueprint

    def show_values(self, shown: Sequence[ShownValue]) -> None:
        """Show the required facts, and whether the entries differ or where the facts come from."""
        super().show_values(shown)
        values = [one.value for one in shown]
        if self._blueprint is None:
            return
        alike = bool(values) and same(values)
        self.facts.show_facts(self._blueprint, values[0] if alike else {})
        if shown and not alike:
            self.say("They require different facts. What is added here replaces those.")
        elif shown and shown[0].written is None and shown[0].standard:
            self.say(f"From {shown[0].origin}.")

    def said(self, value: Any) -> str:
        """The facts with their values; "nothing" for none."""
        return ", ".join(f"{fact} = {one}" for fact, one in value.items()) or "nothing"

    def refuse(self, sentence: str) -> None:
        """Show below the rows why a change was refused."""
        self.refusal.say(sentence)
