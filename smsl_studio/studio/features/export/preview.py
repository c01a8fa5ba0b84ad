"""Preview: sheets of paper in rows, each with its part of a picture."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import QByteArray, QRectF, QSize, QSizeF, Qt
from PySide6.QtGui import QImage, QPainter, QPaintEvent, QPen, QResizeEvent
from PySide6.QtSvg import QSvgRenderer
from PySide6.QtWidgets import QWidget

from smsl_studio.picture.paper import size_of
from smsl_studio.stop import heed
from smsl_studio.studio.base.theme import Tokens

BETWEEN, AROUND = 8.0, 12.0
FINE = 1600
"""The longest side of the picture in a preview (pixels)."""
MOST_ROWS = 12


@dataclass(frozen=True)
class PaperSheet:
    """A sheet of paper with a part of an image on it. Sizes are in any one unit."""

    paper: QSizeF
    image: QImage
    source: QRectF
    """The part, in pixels of the image."""
    target: QRectF
    """Where it lies on the paper."""


def as_image(svg: str) -> QImage:
    """An SVG as an image for a preview. It may be called in any thread."""
    wide, high = size_of(svg)
    scale = min(FINE / max(wide, high), 2.0)
    size = QSize(max(round(wide * scale), 1), max(round(high * scale), 1))
    image = QImage(size, QImage.Format.Format_ARGB32_Premultiplied)
    image.fill(Qt.GlobalColor.transparent)
    heed()
    renderer = QSvgRenderer(QByteArray(svg.encode("utf-8")))
    heed()
    painter = QPainter(image)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    renderer.render(painter)
    painter.end()
    return image


class Preview(QWidget):
    """Shows rows of sheets, as large as they fit."""

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._tokens = tokens
        self.rows: Sequence[Sequence[PaperSheet]] = ()
        """The sheets that are shown, row by row."""
        self._scaled: dict[tuple[int, int, int], QImage] = {}
        self.setMinimumSize(240, 180)
        self.setAccessibleName("Preview")

    def show_rows(self, rows: Sequence[Sequence[PaperSheet]]) -> None:
        """Show other sheets, of many rows only the first ones; none for an empty preview."""
        self.rows = rows[:MOST_ROWS]
        self._scaled.clear()
        self.update()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Scale the images anew for the next paint."""
        self._scaled.clear()
        super().resizeEvent(event)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the sheets in the middle."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
        painter.fillRect(self.rect(), self._tokens.sunk)
        if not self.rows:
            return
        scale = self._scale()
        wide = [_width(row) * scale + BETWEEN * (len(row) - 1) for row in self.rows]
        high = [_height(row) * scale for row in self.rows]
        y = (self.height() - sum(high) - BETWEEN * (len(high) - 1)) / 2
        for row, across, down in zip(self.rows, wide, high, strict=True):
            x = (self.width() - across) / 2
            for sheet in row:
                self._paint_sheet(painter, sheet, x, y, scale)
                x += sheet.paper.width() * scale + BETWEEN
            y += down + BETWEEN

    def _scale(self) -> float:
        free = self.width() - 2 * AROUND, self.height() - 2 * AROUND
        across = min(
            (free[0] - BETWEEN * (len(row) - 1)) / max(_width(row), 1.0) for row in self.rows
        )
        total = sum(_height(row) for row in self.rows)
        return max(min(across, (free[1] - BETWEEN * (len(self.rows) - 1)) / max(total, 1.0)), 1e-6)

    def _paint_sheet(
        self, painter: QPainter, sheet: PaperSheet, x: float, y: float, scale: float
    ) -> None:
        paper = QRectF(x, y, sheet.paper.width() * scale, sheet.paper.height() * scale)
        painter.fillRect(paper, Qt.GlobalColor.white)
        at = sheet.target
        target = QRectF(
            x + at.x() * scale, y + at.y() * scale, at.width() * scale, at.height() * scale
        )
        painter.drawImage(target, self._fine(sheet, target))
        painter.setPen(QPen(self._tokens.line2, 1))
        painter.drawRect(paper)

    def _fine(self, sheet: PaperSheet, target: QRectF) -> QImage:
        """The part of an image on a sheet, scaled smoothly. A painter leaves pixels out."""
        size = (target.size() * self.devicePixelRatioF()).toSize().expandedTo(QSize(1, 1))
        key = id(sheet), size.width(), size.height()
        found = self._scaled.get(key)
        if found is None:
            part = sheet.image.copy(sheet.source.toAlignedRect())
            found = self._scaled[key] = part.scaled(
                size,
                Qt.AspectRatioMode.IgnoreAspectRatio,
                Qt.TransformationMode.SmoothTransformation,
            )
        return found


def _width(row: Sequence[PaperSheet]) -> float:
    return sum(sheet.paper.width() for sheet in row)


def _height(row: Sequence[PaperSheet]) -> float:
    return max(sheet.paper.height() for sheet in row)
