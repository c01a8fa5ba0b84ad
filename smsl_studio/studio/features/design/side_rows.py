"""The rows beside a chosen stage: plain ones, and those with a citation and the part made of it."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QFontMetricsF, QKeyEvent, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QAbstractButton, QHBoxLayout, QSizePolicy, QWidget

from smsl_studio.front.design.parts import MadePart
from smsl_studio.legible import plain_text
from smsl_studio.picture.chip_kinds import VALUE
from smsl_studio.studio.base.chips import paint_chip
from smsl_studio.studio.base.icons import draw
from smsl_studio.studio.base.rows import TextInk, paint_text
from smsl_studio.studio.base.theme import Tokens, text_font
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.features.design.looks import MARKS, mark_colour
from smsl_studio.studio.features.design.sections import SideRow

LOW, TALL = 28, 50
ROOMY = 230
"""In a narrower element the chip of the facts is short (pixels)."""
END = Qt.TextElideMode.ElideRight
MOST_LINES, LINE_HIGH = 4, 18


class RowButton(QAbstractButton):
    """A painted row that may be clicked if it leads somewhere."""

    def __init__(self, tokens: Tokens, words: str, tip: str, leads: bool) -> None:
        super().__init__()
        self.tokens, self._leads = tokens, leads
        self.setText(plain_text(words))
        self.setAccessibleName(plain_text(words))
        self.setToolTip(tip_text(tip))
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus if leads else Qt.FocusPolicy.NoFocus)
        if leads:
            self.setCursor(Qt.CursorShape.PointingHandCursor)
            self.setAttribute(Qt.WidgetAttribute.WA_Hover)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Enter clicks, as Space does."""
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self.click()
        else:
            super().keyPressEvent(event)

    def paint_ground(self, painter: QPainter) -> None:
        """Paint the ground under the pointer or the focus."""
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        if self._leads and (self.underMouse() or self.hasFocus()):
            painter.fillRect(self.rect(), self.tokens.accs if self.hasFocus() else self.tokens.sunk)


class PlainRow(RowButton):
    """Words with a mark, and words at the right. Words alone are wrapped, at most ``MOST_LINES``
    lines."""

    def __init__(self, row: SideRow, tokens: Tokens) -> None:
        self.row = row
        leads = bool(row.address or row.line)
        tip = "\n".join(filter(None, (row.words, row.right)))
        super().__init__(tokens, f"{row.words} {row.right}".strip(), tip, leads)
        self._left = 36 if row.icon or row.mark else 14
        policy = self.sizePolicy()
        if not row.right:
            policy.setVerticalPolicy(QSizePolicy.Policy.Minimum)
            policy.setHeightForWidth(True)
        self.setSizePolicy(policy)

    def sizeHint(self) -> QSize:
        """One line; the layout asks for more if the words need them."""
        return QSize(120, LOW)

    def heightForWidth(self, width: int) -> int:
        """The height that the words need."""
        if self.row.right:
            return LOW
        room = QRectF(0, 0, width - self._left - 14, 1000)
        flags = Qt.TextFlag.TextWordWrap.value
        high = QFontMetricsF(text_font()).boundingRect(room, flags, plain_text(self.row.words))
        lines = max(1, min(MOST_LINES, round(high.height() / LINE_HIGH)))
        return LOW + (lines - 1) * LINE_HIGH

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the row."""
        painter, tokens, row = QPainter(self), self.tokens, self.row
        self.paint_ground(painter)
        icon = row.icon or (MARKS[row.mark] if row.mark else "")
        if icon:
            colour = mark_colour(row.mark, tokens)
            draw(painter, icon, QRectF(14, LOW / 2 - 7, 14, 14), colour, tokens.surf)
        inner = QRectF(self._left, 0, self.width() - self._left - 14, LOW)
        if row.right:
            room = inner.adjusted(inner.width() * 0.4, 0, 0, 0)
            wide = paint_text(painter, room, row.right, TextInk(tokens.tx2, 12), right=True)
            inner.setRight(inner.right() - wide - 10)
        if self.height() <= LOW:
            paint_text(painter, inner, row.words, TextInk(tokens.tx))
        else:
            painter.setFont(text_font())
            painter.setPen(tokens.tx)
            inner.setRect(inner.left(), 5, inner.width(), self.height() - 8)
            flags = Qt.TextFlag.TextWordWrap.value | Qt.AlignmentFlag.AlignTop.value
            painter.drawText(inner, flags, plain_text(row.words))
        painter.end()


class _Citation(RowButton):
    """Quoted words and their place; without any, the warning that there is no source."""

    def __init__(self, part: MadePart, tokens: Tokens) -> None:
        self._part = part
        source = part.sources[0] if part.sources else None
        words = f"“{source.words}”" if source else "No source"
        self.place = source.place if source else "Cite a line, or take it out"
        if len(part.sources) > 1:
            self.place += f", and {len(part.sources) - 1} more"
        super().__init__(tokens, words, f"{words}\n{self.place}", source is not None)

    def sizeHint(self) -> QSize:
        """Two lines."""
        return QSize(60, TALL)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the words over their place."""
        painter, tokens = QPainter(self), self.tokens
        self.paint_ground(painter)
        first = QRectF(14, 5, self.width() - 22, 20)
        second = first.translated(0, 20)
        if self._part.sources:
            paint_text(painter, first, self.text(), TextInk(tokens.tx, 12), elide=END)
            draw(painter, "book", QRectF(14, 28, 13, 13), tokens.acc, tokens.surf)
            second.setLeft(32)
            paint_text(painter, second, self.place, TextInk(tokens.acc, 12))
        else:
            draw(painter, "warning", QRectF(14, 8, 13, 13), tokens.risk, tokens.surf)
            first.setLeft(32)
            paint_text(painter, first, self.text(), TextInk(tokens.risk, 12, 600))
            paint_text(painter, second, self.place, TextInk(tokens.tx2, 12))
        painter.end()


class _Element(RowButton):
    """The state that was made, and its operation."""

    def __init__(self, part: MadePart, tokens: Tokens) -> None:
        self._part = part
        words = ", ".join(filter(None, (part.title, part.operation, part.facts)))
        tip = f"{part.title}\n{part.address}\nShow it in the drawing"
        super().__init__(tokens, words, tip, leads=True)

    def sizeHint(self) -> QSize:
        """Two lines."""
        return QSize(60, TALL)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint an arrow, the facts of the state, its title and the operation."""
        painter, tokens, part = QPainter(self), self.tokens, self._part
        self.paint_ground(painter)
        self._paint_arrow(painter)
        most = 92.0 if self.width() >= ROOMY else 58.0
        wide = min(most, max(44.0, 9.0 * len(part.facts) + 12))
        paint_chip(painter, QRectF(34, 15, wide, 20), part.facts, VALUE, tokens)
        left = 34 + wide + 10
        room = QRectF(left, 5, self.width() - left - 12, 20)
        paint_text(painter, room, part.title, TextInk(tokens.tx, 12), elide=END)
        name = part.operation or part.state.state
        paint_text(painter, room.translated(0, 20), name, TextInk(tokens.tx2, 11, mono=True))
        painter.end()

    def _paint_arrow(self, painter: QPainter) -> None:
        tokens = self.tokens
        pen = QPen(tokens.edge if self._part.sources else tokens.risk, 1.4)
        if not self._part.sources:
            pen.setDashPattern([3, 2])
        painter.setPen(pen)
        painter.drawLine(QPointF(2, 25), QPointF(23, 25))
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(pen.color())
        painter.drawPolygon(QPolygonF([QPointF(30, 25), QPointF(22, 21), QPointF(22, 29)]))


class PartRow(QWidget):
    """A citation beside the part that was made of it."""

    source_wanted = Signal(object)
    """(SourceWords): the text of a citation is wanted."""
    element_wanted = Signal(str)
    """str: the address of the part."""

    def __init__(self, part: MadePart, tokens: Tokens) -> None:
        super().__init__()
        self.part = part
        self.citation, self.element = _Citation(part, tokens), _Element(part, tokens)
        if part.sources:
            self.citation.clicked.connect(lambda: self.source_wanted.emit(part.sources[0]))
        self.element.clicked.connect(lambda: self.element_wanted.emit(str(part.address)))
        across = QHBoxLayout(self)
        across.setContentsMargins(0, 0, 0, 1)
        across.setSpacing(0)
        across.addWidget(self.citation, 1)
        across.addWidget(self.element, 1)
