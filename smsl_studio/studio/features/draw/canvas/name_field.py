"""A field for one name, over the name on the canvas."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QFocusEvent
from PySide6.QtWidgets import QVBoxLayout, QWidget

from smsl_studio.studio.base.overlays.card import PassingCard
from smsl_studio.studio.base.overlays.name_line import NameLine, complain, error_label
from smsl_studio.studio.base.theme import Tokens


class NameField(PassingCard):
    """A field that edits one name on the canvas.

    ``commit`` takes the text and returns why it is refused, or the empty text. Enter commits; Esc
    closes the field without an edit. A click elsewhere commits a changed name. A refused name stays
    in the field, with the reason below it.
    """

    def __init__(
        self,
        parent: QWidget,
        tokens: Tokens,
        text: str,
        hint: str,
        commit: Callable[[str], str],
    ) -> None:
        super().__init__(parent, tokens, 8.0)
        self._commit, self._before = commit, text
        self.field = NameLine(self, tokens, hint)
        self.field.setText(text)
        self.field.selectAll()
        self.error = error_label(self, tokens)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(4, 4, 4, 4)
        layout.setSpacing(4)
        layout.addWidget(self.field)
        layout.addWidget(self.error)
        self.field.done.connect(self.commit)
        self.field.left.connect(self.close_field)
        self.field.textEdited.connect(lambda: self._complain(""))
        self.field.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Commit or close when the field loses the keyboard focus, but not to a menu or another
        window."""
        if isinstance(event, QFocusEvent) and event.type() is QEvent.Type.FocusOut:
            kept = {Qt.FocusReason.PopupFocusReason, Qt.FocusReason.ActiveWindowFocusReason}
            if event.reason() not in kept and not self._closing:
                self._lost_focus()
        return False

    def take_focus(self) -> None:
        """Give the keyboard to the name."""
        self.field.setFocus()

    @property
    def complaint(self) -> str:
        """Why the name was refused; empty if it was not."""
        return self.error.text()

    def commit(self) -> None:
        """Take the name over. If that is refused, show why and keep what was typed."""
        if self._closing:
            return
        reason = self._commit(self.field.text().strip())
        if reason:
            self._complain(reason)
            self.field.setFocus()
        else:
            self.close_field()

    def _lost_focus(self) -> None:
        """Commit a changed name; close the field unless that is refused."""
        text = self.field.text().strip()
        if not text or text == self._before:
            self.close_field()
            return
        reason = self._commit(text)
        if reason:
            self._complain(reason)
        else:
            self.close_field()

    def _complain(self, reason: str) -> None:
        if reason:
            self.setMinimumWidth(max(self.width(), 230))
        complain(self.error, reason, max(self.width(), 230) - 12)
        self.adjustSize()
