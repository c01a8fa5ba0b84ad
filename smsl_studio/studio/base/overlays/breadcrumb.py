"""The breadcrumb: file, base SBs, and the SB that is shown. All but the last can be clicked."""

from __future__ import annotations

from pathlib import PurePath

from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QFontMetricsF,
    QMouseEvent,
    QPainter,
    QPaintEvent,
)
from PySide6.QtWidgets import QWidget

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.graph.layout import is_grid
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.icons import draw
from smsl_studio.studio.base.paint.ink import Type
from smsl_studio.studio.base.theme import RADIUS_CHIP, Tokens, text_font
from smsl_studio.studio.base.tips import tip_text

EDGE, NARROWEST, VEIL = 14, 72.0, 235
"""Pixels left free at both sides of the breadcrumb.

The smallest width of a shortened name (pixels); the opacity of its background (of 255).
"""


def chain(blueprint: Blueprint, branch: str) -> tuple[str, ...]:
    """The SBs from a root down to ``branch``, along the first base that each names."""
    found = [branch]
    while blueprint.bases.get(found[0]):
        base = blueprint.bases[found[0]][0][0]
        if base in found:
            break
        found.insert(0, base)
    return tuple(found)


class Breadcrumb(QWidget):
    """The path at the top left. ``clicked`` carries the SB to show, empty for the file."""

    clicked = Signal(str)

    def __init__(self, parent: QWidget, tokens: Tokens) -> None:
        super().__init__(parent)
        self.tokens = tokens
        self._plain, self._bold = Type(text_font(13)), Type(text_font(13, 600))
        self._file = ""
        self._chain: tuple[str, ...] = ()
        self._note = ""
        self._brief = False
        self._under = -1
        self.setMouseTracking(True)
        self.setAccessibleName("Path")

    def show_branch(self, blueprint: Blueprint, branch: str) -> None:
        """Show the path to an SB."""
        self._file = blueprint.file.replace("\\", "/").rpartition("/")[2]
        self._chain = chain(blueprint, branch) if branch in blueprint.branches else ()
        self._note = ""
        if self._chain:
            shown = blueprint[branch]
            states, operations = len(shown.table), shown.edge_count
            home = blueprint.imported.get(branch)
            where = f"in {PurePath(home.file).name}, " if home is not None else ""
            self.setToolTip(tip_text(home.file if home is not None else blueprint.file))
            self._note = (
                f"{where}{states:,} state{'' if states == 1 else 's'}, "
                f"{operations:,} operation{'' if operations == 1 else 's'}"
            )
            if is_grid(shown):
                self._note += f", very many, so in columns from {shown.initial}"
        self.setAccessibleDescription(plain_text(" > ".join((self._file, *self._chain))))
        self.resize(self.sizeHint())
        self.update()

    def set_brief(self, brief: bool) -> None:
        """Show the path alone, without the numbers behind it."""
        if brief != self._brief:
            self._brief = brief
            self.update()

    @property
    def note(self) -> str:
        """The words behind the path: the numbers of states and operations of the SB."""
        return "" if self._brief else self._note

    @property
    def words(self) -> tuple[str, ...]:
        """The parts of the path, beginning with the file."""
        return (self._file, *self._chain)

    def place_of(self, part: int) -> QRectF:
        """The rectangle of a part in the widget; part 0 is the file."""
        return self._places()[part]

    def _places(self) -> list[QRectF]:
        x, places = 22.0, []
        for width in self._widths():
            places.append(QRectF(x, 0.0, width, 26.0))
            x += width + 22.0
        return places

    def _widths(self) -> list[float]:
        """The width of each name (pixels). In a narrow view names are shortened, the file first."""
        last = len(self._chain)
        widths = [(self._bold if i == last > 0 else self._plain).width(text)
                  for i, text in enumerate(self.words)]  # fmt: skip
        beside = 22.0 * len(widths) + 20 + self._plain.width(self.note)
        parent = self.parentWidget()
        room = (parent.width() if parent is not None else 0) - 2 * EDGE - beside
        for i, width in enumerate(widths):
            over = sum(widths) - room
            if over > 0:
                widths[i] = max(min(width, NARROWEST), width - over)
        return widths

    def sizeHint(self) -> QSize:
        """Wide enough for the whole path and the note behind it."""
        last = self._places()[-1].right()
        return QSize(int(last + 12 + self._plain.width(self.note) + 8), 26)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Underline the part under the pointer, if it can be clicked."""
        at = event.position()
        found = (i for i, rect in enumerate(self._places()) if rect.contains(at))
        under = next(found, -1)
        under = under if under < len(self._chain) else -1
        if under != self._under:
            self._under = under
            if under >= 0:
                self.setCursor(Qt.CursorShape.PointingHandCursor)
            else:
                self.unsetCursor()
            self.update()

    def leaveEvent(self, event: QEvent) -> None:
        """Underline no part."""
        self._under = -1
        self.update()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Take the press, so that the canvas below begins no gesture."""
        event.accept()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Emit ``clicked`` for the part under the pointer."""
        for i, rect in enumerate(self._places()):
            if rect.contains(event.position()) and i < len(self._chain):
                self.clicked.emit(self._chain[i - 1] if i else "")
                return

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the parts on a background that half hides the drawing."""
        tokens = self.tokens
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        # The drawing below must not be visible through the names.
        behind = QColor(tokens.canvas)
        behind.setAlpha(VEIL)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(behind)
        painter.drawRoundedRect(self.rect(), RADIUS_CHIP, RADIUS_CHIP)
        draw(painter, "file", QRectF(0, 5.5, 15, 15), tokens.tx2, tokens.canvas)
        places = self._places()
        for i, (text, rect) in enumerate(zip(self.words, places, strict=True)):
            last = i == len(self._chain) and bool(self._chain)
            font = text_font(13, 600 if last else 400)
            font.setUnderline(i == self._under)
            painter.setFont(font)
            painter.setPen(tokens.tx if last else tokens.acc if i == self._under else tokens.tx2)
            baseline = QPointF(rect.left(), 13.0 + QFontMetricsF(font).capHeight() / 2)
            shown = QFontMetricsF(font).elidedText(
                plain_text(text), Qt.TextElideMode.ElideMiddle, rect.width() + 0.5
            )
            painter.drawText(baseline, shown)
            if not last and i < len(places) - 1:
                box = QRectF(rect.right() + 5.0, 8.0, 11.0, 11.0)
                draw(painter, "chevron-right", box, tokens.tx3, tokens.canvas)
        if self.note:
            painter.setFont(text_font(13))
            painter.setPen(tokens.tx3)
            base = 13.0 + QFontMetricsF(text_font(13)).capHeight() / 2
            painter.drawText(QPointF(places[-1].right() + 12.0, base), plain_text(self.note))
        painter.end()
