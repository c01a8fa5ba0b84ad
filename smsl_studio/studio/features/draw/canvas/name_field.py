"""One name, edited where it stands; a refusal is said beside it and nothing typed is lost."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QFocusEvent
from PySide6.QtWidgets import QVBoxLayout, QWidget

from smsl_studio.studio.base.overlays.card import PassingCard
from smsl_studio.studio.base.overlays.name_line import NameLine, complain, error_label
from smsl_studio.studio.base.theme import Tokens


class NameField(PassingCard):
    """One name, edited where it stands.

    ``commit`` takes the text and answers with the reason it was refused, or with the empty text.
    Enter commits, Esc leaves everything as it was; leaving by a click elsewhere commits what fits.
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
        """Commit or close when the keys go elsewhere, but not for a menu or another window."""
        if isinstance(event, QFocusEvent) and event.type() is QEvent.Type.FocusOut:
            kept = {Qt.FocusReason.PopupFocusReason, Qt.FocusReason.ActiveWindowFocusReason}
            if event.reason() not in kept and not self._closing:
                self._lost_focus()
        return False

    @property
    def complaint(self) -> str:
        """Why the name was refused; the empty text while nothing is wrong."""
        return self.error.text()

    def commit(self) -> None:
        """Take the name over; a refusal is said, and what was typed stays."""
        if self._closing:
            return
        reason = self._commit(self.field.text().strip())
        if reason:
            self._complain(reason)
            self.field.setFocus()
        else:
            self.close_field()

    def _lost_focus(self) -> None:
        """Somebody went elsewhere: a new name is taken over, one that does not fit stays here."""
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
