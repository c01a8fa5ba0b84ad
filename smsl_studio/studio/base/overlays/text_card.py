"""A card over the canvas in which one text is edited."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QFocusEvent
from PySide6.QtWidgets import QVBoxLayout, QWidget

from smsl_studio.studio.base.overlays.card import PassingCard
from smsl_studio.studio.base.overlays.name_line import complain, error_label
from smsl_studio.studio.base.theme import Tokens

KEEPS = {Qt.FocusReason.PopupFocusReason, Qt.FocusReason.ActiveWindowFocusReason}
"""The reasons for a loss of the keyboard focus that do not close the card: a menu or another window
is open, and the person will come back to the field.
"""

WIDE = 230
"""The least width of a card with a reason (pixels)."""


class TextCard(PassingCard):
    """A card with a field and, below it, the reason why its text is refused.

    ``commit`` takes the text and returns why it is refused, or the empty text. Subclasses say how a
    text is read and what happens when the field is left.
    """

    def __init__(self, parent: QWidget, tokens: Tokens, commit: Callable[[str], str]) -> None:
        super().__init__(parent, tokens, 8.0)
        self._commit = commit
        self.error = error_label(self, tokens)
        self.column = QVBoxLayout(self)
        self.column.setContentsMargins(4, 4, 4, 4)
        self.column.setSpacing(4)

    def hold(self, field: QWidget) -> None:
        """Put in the field. When it loses the keyboard focus, ``settle`` is called."""
        self.column.addWidget(field)
        self.column.addWidget(self.error)
        field.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Settle when the person leaves the field. A menu or another window does not count."""
        lost = isinstance(event, QFocusEvent) and event.lostFocus() and event.reason() not in KEEPS
        if lost and not self._closing:
            self.settle()
        return False

    def settle(self) -> None:
        """Accept the text if it was changed. Otherwise close the card."""
        raise NotImplementedError

    def take(self, text: str) -> bool:
        """Accept a text and close the card. If it is refused, show why and return False."""
        if self._closing:
            return True
        reason = self._commit(text)
        if reason:
            self.complain(reason)
        else:
            self.close_field()
        return not reason

    def complain(self, reason: str) -> None:
        """Show why a text is refused. The empty text hides the reason."""
        wide = max(self.width(), WIDE)
        if reason:
            self.setMinimumWidth(wide)
        complain(self.error, reason, wide - 12)
        self.adjustSize()
