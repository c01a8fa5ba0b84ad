"""LibraryDrop: shows what a thing dragged from the library would do, and does it at the drop."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from PySide6.QtCore import QEvent, QMimeData, QObject, QPoint, QPointF
from PySide6.QtGui import (
    QDragEnterEvent,
    QDragMoveEvent,
    QDropEvent,
)

from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.features.draw.canvas.intent import Intent

KIND = "application/x-smsl-library"
"""The type of what is dragged. Its text is a kind and a name: ``operation Op_1b``."""


def library_data(kind: str, name: str) -> QMimeData:
    """What is dragged: an operation or a template."""
    data = QMimeData()
    data.setData(KIND, f"{kind} {name}".encode())
    return data


class Drop(Protocol):
    """What each place of the canvas would make of one dragged thing."""

    def at(self, point: QPointF) -> Intent:
        """What a drop at a scene point would do."""


class LibraryDrop(QObject):
    """Watches the drags over a canvas.

    ``drop_for`` gives the drop of a kind and a name.
    """

    def __init__(self, canvas: Canvas, drop_for: Callable[[str, str], Drop]) -> None:
        super().__init__(canvas)
        self._canvas, self._drop_for = canvas, drop_for
        self._drop: Drop | None = None
        self.intent: Intent | None = None
        """What a drop would do now; None while nothing is dragged."""
        canvas.viewport().installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Take the events of drags from the library; others go on, such as those of files."""
        if isinstance(event, QDragEnterEvent):
            self._drop = self._found(event.mimeData())
            if self._drop is not None:
                # In a narrow window the library lies over the canvas until it loses the focus.
                self._canvas.setFocus()
                self._canvas.overlays.pad.go()
            return self._show(event)
        if isinstance(event, QDragMoveEvent):
            return self._show(event)
        if event.type() is QEvent.Type.DragLeave and self._drop is not None:
            self._end()
            return True
        if isinstance(event, QDropEvent):
            return self._let_go(event)
        return False

    def _found(self, data: QMimeData) -> Drop | None:
        if not data.hasFormat(KIND) or not self._canvas.editing:
            return None
        kind, _, name = bytes(data.data(KIND).data()).decode().partition(" ")
        return self._drop_for(kind, name)

    def _show(self, event: QDragMoveEvent) -> bool:
        if self._drop is None:
            return False
        self.intent = self._drop.at(self._scene_point(event))
        self._canvas.gestures.put("sketch", self.intent.sketch)
        self._canvas.overlays.say(self.intent.words, event.position().toPoint() + QPoint(0, 12))
        # A drag that is not accepted would get no further events here.
        event.acceptProposedAction()
        return True

    def _let_go(self, event: QDropEvent) -> bool:
        drop = self._drop
        if drop is None:
            return False
        intent = drop.at(self._scene_point(event))
        self._end()
        event.acceptProposedAction()
        self._canvas.setFocus()
        if intent.act is not None:
            intent.act()
        else:
            self._canvas.overlays.say(intent.words, event.position().toPoint())
        return True

    def _end(self) -> None:
        self._drop = self.intent = None
        self._canvas.gestures.put("sketch", None)
        self._canvas.overlays.hush()

    def _scene_point(self, event: QDropEvent) -> QPointF:
        return self._canvas.mapToScene(event.position().toPoint())
