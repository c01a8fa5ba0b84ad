"""The start page: what can be begun, what was open last, and the samples."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QEvent, QObject
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QFrame, QScrollArea

from smsl_studio.blueprint.project import project_of
from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.start.column import Column
from smsl_studio.studio.features.start.thumbnails import FileLook, Thumbnails


class StartPage(QScrollArea):
    """Shows the column, and scrolls it if the window is low."""

    def __init__(self, settings: Settings, tokens: Tokens) -> None:
        super().__init__()
        self._settings = settings
        self.setObjectName("start_page")
        self.setAccessibleName("Start page")
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setWidgetResizable(True)
        self.column = Column(tokens)
        self.setWidget(self.column)
        self.thumbnails = Thumbnails(self)
        self.column.focused.connect(self._follow)
        self.column.removed.connect(self._forget)
        self.setFocusProxy(self.column.cards[0])
        self.look()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.column.set_tokens(tokens)

    def look(self) -> None:
        """Show the recent files as they are now."""
        recent = [(path, self._settings.opened(path)) for path in self._settings.recent]
        if self.column.show_recent(recent):
            self.thumbnails.look((path for path, _ in recent), self._found)
        # Somebody may have signed or revoked meanwhile.
        named = [(path, self._settings.policy_of(project_of(str(path)))) for path, _ in recent]
        self.thumbnails.look_at_trust(named, self.column.show_trust)

    def stop(self) -> None:
        """Draw no more thumbnails."""
        self.thumbnails.stop()

    def showEvent(self, event: QShowEvent) -> None:
        """Look at the files when the page stands there; that does not delay it."""
        super().showEvent(event)
        self.look()
        waiting = [card.path for card in self.column.samples if card.miniature is None]
        self.thumbnails.look(waiting, self._found)
        self.window().installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Look again when the person comes back: another window may have opened a file."""
        if event.type() == QEvent.Type.WindowActivate and self.isVisible():
            self.look()
        return super().eventFilter(watched, event)

    def _found(self, path: Path, found: FileLook) -> None:
        self.column.show_found(path, found)

    def _forget(self, path: Path) -> None:
        self._settings.forget(path)
        self.look()

    def _follow(self) -> None:
        """Keep the tile with the focus in view, and give it the keys when they come back."""
        tile = self.column.current
        if tile is not None:
            self.setFocusProxy(tile)
            self.ensureWidgetVisible(tile, 8, 24)
