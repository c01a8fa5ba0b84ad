"""The list of undo steps. A click goes back or forward to a step."""

from __future__ import annotations

from PySide6.QtWidgets import QUndoView, QWidget

from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.document.session import Session


class History(QUndoView):
    """The steps since the file was opened; the present one is marked."""

    def __init__(self, session: Session, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(session.history, parent)
        self.setProperty("role", "list")
        self.setAccessibleName("History")
        self.setEmptyLabel("As it was opened")
        self.setToolTip("Click a step to go there")

    def keyboardSearch(self, search: str, /) -> None:
        """Do nothing: typed letters must not undo or redo many steps."""
