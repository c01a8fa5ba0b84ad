"""Files that a person drops onto a window."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QEvent, QObject, QTimer
from PySide6.QtGui import QDragEnterEvent, QDropEvent
from PySide6.QtWidgets import QWidget


class DroppedFiles(QObject):
    """Opens dropped files: the first one in this window, each other one in a new window."""

    def __init__(
        self, open_here: Callable[[Path], object], open_beside: Callable[[Path], object],
        window: QWidget,
    ) -> None:  # fmt: skip
        super().__init__(window)
        self._here, self._beside = open_here, open_beside
        window.setAcceptDrops(True)
        window.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Accept local files that are dragged over the window, and open dropped ones."""
        if isinstance(event, QDragEnterEvent):
            if any(url.isLocalFile() for url in event.mimeData().urls()):
                event.acceptProposedAction()
            return True
        if isinstance(event, QDropEvent) and event.type() == QEvent.Type.Drop:
            urls = event.mimeData().urls()
            paths = [Path(url.toLocalFile()) for url in urls if url.isLocalFile()]
            if paths:
                event.acceptProposedAction()
                # The other program waits until this method returns, and opening may ask questions.
                QTimer.singleShot(0, self, lambda: self._open(paths))
            return True
        return super().eventFilter(watched, event)

    def _open(self, paths: list[Path]) -> None:
        self._here(paths[0])
        for path in paths[1:]:
            self._beside(path)
