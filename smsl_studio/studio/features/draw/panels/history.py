"""History: every step by name; a click goes there."""

from __future__ import annotations

from PySide6.QtWidgets import QUndoView, QWidget

from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.document.session import Session


class History(QUndoView):
    """The steps since the file was opened, the present one marked."""

    def __init__(self, session: Session, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(session.history, parent)
        self.setProperty("role", "list")
        self.setAccessibleName("History")
        self.setEmptyLabel("As it was opened")
        self.setToolTip("Click a step to go there")

    def keyboardSearch(self, search: str, /) -> None:
        """Letters choose no step: every step between here and there would be undone."""
