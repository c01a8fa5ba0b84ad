"""The samples of the start page: their cards, and the sentence on each."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QRectF
from PySide6.QtGui import QPainter, QPainterPath, QPen
from PySide6.QtWidgets import QWidget

from smsl_studio.picture.miniature import Miniature
from smsl_studio.shipped import samples_dir
from smsl_studio.studio.base.paint import batch
from smsl_studio.studio.base.paint.miniature_paint import paint_miniature
from smsl_studio.studio.base.theme import RADIUS_CARD, Tokens
from smsl_studio.studio.document.files.sample_titles import SAMPLES, ShownSample
from smsl_studio.studio.features.start.tile import Tile

WIDE, HIGH, PICTURE = 216, 164, 88


def shown_samples() -> tuple[tuple[Path, ShownSample], ...]:
    """The samples that are there, in order."""
    folder = samples_dir()
    found = ((folder / sample.file, sample) for sample in SAMPLES)
    return tuple((path, sample) for path, sample in found if path.is_file())


class SampleCard(Tile):
    """A card with a picture of the sample."""

    def __init__(self, path: Path, sample: ShownSample, tokens: Tokens, parent: QWidget) -> None:
        super().__init__(sample.title, f"{sample.words} Opens a copy.", tokens, parent)
        self.path, self._sample = path, sample
        self.miniature: Miniature | None = None
        self.tip(f"Open a copy of {path.name}")

    def show_miniature(self, drawn: Miniature | None) -> None:
        """Show the picture."""
        self.miniature = drawn
        self.update()

    def paint_content(self, painter: QPainter) -> None:
        """Paint the picture, the title and the sentence."""
        tokens, wide = self.tokens, self.width()
        box = QRectF(1, 1, wide - 2, PICTURE - 1)
        shape = QPainterPath()
        shape.addRoundedRect(QRectF(1, 1, wide - 2, HIGH - 2), RADIUS_CARD - 1, RADIUS_CARD - 1)
        painter.save()
        painter.setClipPath(shape)
        painter.fillRect(box, tokens.canvas)
        painter.setClipRect(box)
        batch.draw_grid(painter, box, 16, 1, tokens.dot)
        painter.restore()
        if self.miniature is not None:
            paint_miniature(painter, box, self.miniature, tokens)
        painter.setPen(QPen(tokens.line, 1))
        painter.drawLine(1, PICTURE, wide - 2, PICTURE)
        painter.setPen(tokens.tx)
        self.say(painter, QRectF(14, PICTURE + 8, wide - 28, 20), self._sample.title, 13, 600)
        painter.setPen(tokens.tx2)
        self.say_wrapped(painter, QRectF(14, PICTURE + 30, wide - 28, 40), self._sample.words, 12)
