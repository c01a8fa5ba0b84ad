"""The field for a condition of a claim."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.properties.completion import Offers, offers_at
from smsl_studio.studio.base.lines.offer_field import OfferField
from smsl_studio.studio.base.theme import Tokens


class FormulaField(OfferField):
    """A field with offers of facts and states, while its text is a condition."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__(tokens, self._offers_at)
        self._blueprint: Blueprint | None = None
        self.formulas = True
        """Whether the text is a condition. Otherwise it has no offers."""

    def set_blueprint(self, blueprint: Blueprint) -> None:
        """Offer the names of this blueprint."""
        self._blueprint = blueprint

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Escape closes the offers, and else is for the form: it asks before it drops a text."""
        if event.key() != Qt.Key.Key_Escape:
            super().keyPressEvent(event)
        elif not self.offers.takes(event):
            event.ignore()

    def _offers_at(self, text: str, caret: int) -> Offers:
        if self._blueprint is None or not self.formulas:
            return Offers(caret, ())
        return offers_at(text, caret, self._blueprint)
