"""A field of a form with offers for the place of the caret, and a mark at a fault."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtGui import QKeyEvent, QPaintEvent

from smsl_studio.blueprint.properties.completion import Offers
from smsl_studio.studio.base.controls import Field
from smsl_studio.studio.base.lines.offer_list import OfferList, paint_fault
from smsl_studio.studio.base.theme import Tokens, mono_font


class OfferField(Field):
    """A field whose text counts after Enter or when it is left. Ctrl+Space opens the offers."""

    def __init__(self, tokens: Tokens, offers_at: Callable[[str, int], Offers]) -> None:
        super().__init__()
        self._tokens, self._fault = tokens, -1
        self.setFont(mono_font(12, 400))
        self.offers = OfferList(self, offers_at)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def mark(self, at: int) -> None:
        """Mark the word at an offset of the text as wrong; -1 marks nothing."""
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
