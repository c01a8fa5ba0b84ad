"""The card of links after the samples."""

from __future__ import annotations

from PySide6.QtCore import QRectF, Qt, QUrl
from PySide6.QtGui import QDesktopServices, QPainter, QPaintEvent, QPen, QResizeEvent
from PySide6.QtWidgets import QWidget

from smsl_studio.shipped import samples_dir
from smsl_studio.studio.base.icons import draw
from smsl_studio.studio.base.theme import RADIUS_CARD, Tokens
from smsl_studio.studio.features.start.tile import Tile

HIGH = 32


class LinkCard(QWidget):
    """A dashed card with a link in each row."""

    def __init__(self, tokens: Tokens, parent: QWidget) -> None:
        super().__init__(parent)
        self._tokens = tokens
        self.setAccessibleName("More")
        self.help = Link("The first blueprint, as a page", "file", tokens, self)
        self.folder = Link("Show the samples folder", "folder", tokens, self)
        self.folder.clicked.connect(show_samples_folder)
        self.rules = Link("Generate from rules", "pencil", tokens, self)
        self.texts = Link("Generate from text", "book", tokens, self)
        self.tiles = (self.help, self.folder, self.texts, self.rules)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme for the frame."""
        self._tokens = tokens
        self.update()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Place the links in the middle."""
        super().resizeEvent(event)
        top = (self.height() - len(self.tiles) * (HIGH + 4) + 4) // 2
        for at, tile in enumerate(self.tiles):
            tile.setGeometry(8, top + at * (HIGH + 4), self.width() - 16, HIGH)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint a dashed frame."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        pen = QPen(self._tokens.line2, 1)
        pen.setDashPattern([4, 3])
        painter.setPen(pen)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        box = QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5)
        painter.drawRoundedRect(box, RADIUS_CARD, RADIUS_CARD)
        painter.end()


class Link(Tile):
    """One link with its icon."""

    def __init__(self, words: str, icon: str, tokens: Tokens, parent: QWidget) -> None:
        super().__init__(words, "", tokens, parent)
        self._icon = icon

    def paint_ground(self, painter: QPainter) -> None:
        """Paint nothing: the card is below."""

    def paint_content(self, painter: QPainter) -> None:
        """Paint icon and words; they are underlined under the pointer."""
        tokens = self.tokens
        draw(painter, self._icon, QRectF(8, HIGH / 2 - 7, 14, 14), tokens.acc, tokens.canvas)
        painter.setPen(tokens.acc)
        at = QRectF(32, 0, self.width() - 40, HIGH)
        self.say(painter, at, self.text(), 13, 500)
        if self.underMouse():
            wide = painter.fontMetrics().horizontalAdvance(self.text())
            painter.drawLine(32, HIGH - 8, 32 + wide, HIGH - 8)


def show_samples_folder() -> None:
    """Show the folder of the samples in the desktop's own program for files."""
    QDesktopServices.openUrl(QUrl.fromLocalFile(str(samples_dir())))
