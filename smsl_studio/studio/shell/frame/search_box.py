"""The field of the mode bar that opens the command palette."""

from __future__ import annotations

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QPainter, QPaintEvent, QPalette, QPen
from PySide6.QtWidgets import QAbstractButton, QSizePolicy

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.icons import draw
from smsl_studio.studio.base.theme import Tokens, text_font

SEARCH = 248
"""Largest width of the search field; it becomes narrower in a narrow bar (pixels)."""
BRIEF = "Find"
"""The word in a search field that is too narrow for its sentence."""


class SearchBox(QAbstractButton):
    """A button that looks like a search field and opens the command palette."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._tokens = tokens
        self.setFixedHeight(32)
        self.setMinimumWidth(44)
        self.setMaximumWidth(SEARCH)
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Fixed)
        self.setText("Find or run a command")
        self.setAccessibleName("Find or run a command")
        self.setToolTip("Find a state or operation, or run a command (Ctrl+K)")
        self.setCursor(Qt.CursorShape.IBeamCursor)
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)

    def sizeHint(self) -> QSize:
        """The width at which the words and the key fit."""
        return QSize(SEARCH, 32)

    def minimumSizeHint(self) -> QSize:
        """Wide enough for the icon."""
        return QSize(44, 32)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint a field with icon, words and shortcut."""
        tokens, painter = self._tokens, QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        edge = self.palette().color(QPalette.ColorRole.Accent) if self.hasFocus() else tokens.nl
        painter.setPen(QPen(edge, 2 if self.hasFocus() else 1))
        painter.setBrush(tokens.surf)
        box = QRectF(self.rect()).adjusted(1, 1, -1, -1)
        painter.drawRoundedRect(box, 6, 6)
        draw(painter, "search", QRectF(10, 9, 14, 14), tokens.tx2, tokens.surf)
        painter.setPen(tokens.tx2)
        painter.setFont(text_font(13))
        roomy = self.width() > SEARCH - 40
        words = self.rect().adjusted(33, 0, -60 if roomy else -8, 0)
        right = Qt.TextElideMode.ElideRight
        metrics, whole = painter.fontMetrics(), plain_text(self.text())
        said = whole if metrics.horizontalAdvance(whole) <= words.width() + 1 else BRIEF
        shown = metrics.elidedText(said, right, words.width() + 1)
        painter.drawText(words, Qt.AlignmentFlag.AlignVCenter, shown)
        if not roomy:
            painter.end()
            return
        key = QRectF(self.width() - 51, 7, 42, 18)
        painter.setPen(QPen(tokens.line, 1))
        painter.setBrush(tokens.win)
        painter.drawRoundedRect(key, 4, 4)
        painter.setPen(tokens.tx2)
        painter.setFont(text_font(11, 500))
        painter.drawText(key, Qt.AlignmentFlag.AlignCenter, "Ctrl K")
