"""The field for a condition: completion, and a mark at the place of a fault."""

from __future__ import annotations

from PySide6.QtGui import QKeyEvent, QPaintEvent
from PySide6.QtWidgets import QLineEdit, QWidget

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.properties.completion import Offers, offers_at
from smsl_studio.studio.base.lines.offer_list import OfferList, paint_fault
from smsl_studio.studio.base.theme import Tokens, mono_font


class FormulaField(QLineEdit):
    """A line for a condition. Ctrl+Space opens the offers, Enter takes one."""

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._tokens = tokens
        self._blueprint: Blueprint | None = None
        self._fault = -1
        self.formulas = True
        """Whether the text is a condition. Otherwise it has no offers."""
        self.setFont(mono_font(12, 400))
        self.offers = OfferList(self, self._offers_at)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def set_blueprint(self, blueprint: Blueprint) -> None:
        """Offer the names of this blueprint."""
        self._blueprint = blueprint

    def mark(self, at: int) -> None:
        """Mark the text from an offset on as wrong; -1 marks nothing."""
        if at != self._fault:
            self._fault = at
            self.update()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Keys of the offers go to them, others type."""
        if not self.offers.takes(event):
            super().keyPressEvent(event)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint a wave below the text at the place of the fault."""
        super().paintEvent(event)
        if self._fault >= 0:
            paint_fault(self, self._fault, self._tokens.bad)

    def _offers_at(self, text: str, caret: int) -> Offers:
        if self._blueprint is None or not self.formulas:
            return Offers(caret, ())
        return offers_at(text, caret, self._blueprint)
