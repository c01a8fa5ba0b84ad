"""The list of the library: its rows can be dragged to the canvas."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QMimeData, QPoint, QRectF, Qt
from PySide6.QtGui import QDrag, QPainter, QPixmap
from PySide6.QtWidgets import QWidget

from smsl_studio.studio.base.paint.ink import Type
from smsl_studio.studio.base.rows import ListRow, RowsView
from smsl_studio.studio.base.theme import Tokens, text_font

WIDEST = 220
"""The widest tag at the pointer, in pixels."""


class LibraryList(RowsView):
    """Rows of which each can be dragged, as ``dragged`` says (None: not this one)."""

    def __init__(
        self,
        tokens: Tokens,
        dragged: Callable[[ListRow], QMimeData | None],
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(tokens, parent)
        self._tokens, self._dragged = tokens, dragged
        self.rows.draggable = True
        self.setDragEnabled(True)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        super().set_tokens(tokens)
        self._tokens = tokens

    def startDrag(self, actions: Qt.DropAction) -> None:
        """Drag the current row, with its name above the pointer."""
        row = self.currentIndex().data(Qt.ItemDataRole.UserRole)
        data = self._dragged(row) if isinstance(row, ListRow) else None
        if data is None:
            return
        drag = QDrag(self)
        drag.setMimeData(data)
        tag = self._tag(row.text)
        drag.setPixmap(tag)
        # What the drop will do is told below the pointer.
        drag.setHotSpot(QPoint(-10, round(tag.height() / tag.devicePixelRatio()) + 6))
        drag.exec(Qt.DropAction.CopyAction)

    def _tag(self, text: str) -> QPixmap:
        type_, ratio = Type(text_font(12, 500)), self.devicePixelRatioF()
        shown = type_.elided(text, WIDEST - 20)
        wide, high = type_.width(shown) + 20, 26.0
        tag = QPixmap(round(wide * ratio), round(high * ratio))
        tag.setDevicePixelRatio(ratio)
        tag.fill(Qt.GlobalColor.transparent)
        painter = QPainter(tag)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(self._tokens.acc)
        painter.setBrush(self._tokens.surf)
        painter.drawRoundedRect(QRectF(0.5, 0.5, wide - 1, high - 1), 6, 6)
        type_.draw(painter, wide / 2, high / 2, shown, self._tokens.tx)
        painter.end()
        return tag
