"""What is to be done next, in its order. A click on a row chooses the stage; it starts nothing."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QKeyEvent, QPainter, QPaintEvent, QPen, QResizeEvent
from PySide6.QtWidgets import QAbstractButton, QPushButton, QWidget

from smsl_studio.front.design.stages import NextStep
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.rows import TextInk, paint_text
from smsl_studio.studio.base.theme import RADIUS_CARD, Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import as_it_is
from smsl_studio.studio.features.design.card import paint_disc

HEAD, ROW, FOOT = 36, 26, 40
MOST = 5
"""So many steps are listed; the others follow from them."""


class NextBox(QWidget):
    """The list, with a button that leads to the element that is to be mended first."""

    chosen = Signal(int)
    """int: the number of the stage of a step."""
    place_wanted = Signal(str)
    """str: the address of an element."""

    def __init__(self, tokens: Tokens, parent: QWidget) -> None:
        super().__init__(parent)
        self._tokens = tokens
        self.steps: tuple[NextStep, ...] = ()
        self.rows: tuple[_StepRow, ...] = ()
        self._place = ""
        self.go = QPushButton(self)
        self.go.setProperty("role", "soft")
        self.go.setAutoDefault(False)
        self.go.clicked.connect(lambda: self.place_wanted.emit(self._place))
        self.setAccessibleName("Next, in this order")
        self.show_steps(())

    def show_steps(self, steps: Sequence[NextStep]) -> None:
        """Show these steps, the first ones with their words."""
        self.steps = tuple(steps)
        self._place = next((one.address for one in steps if one.address), "")
        name = self._place.rpartition("/")[2]
        self.go.setText(as_it_is(f"Go to {name[:40]}"))
        self.go.setToolTip(tip_text(f"Show {self._place} in the drawing"))
        self.go.setVisible(bool(self._place))
        if [one.step for one in self.rows] != list(self.steps[:MOST]):
            for row in self.rows:
                row.hide()
                row.deleteLater()
            self.rows = tuple(_StepRow(step, self._tokens, self) for step in self.steps[:MOST])
            for row in self.rows:
                row.clicked.connect(lambda _=False, n=row.step.number: self.chosen.emit(n))
                row.show()
        self._place_parts()
        self.update()

    def height_of_all(self) -> int:
        """The height that the rows need."""
        return HEAD + MOST * ROW + FOOT

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        for row in self.rows:
            row.set_tokens(tokens)
        self.update()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Place the rows for the new size."""
        super().resizeEvent(event)
        self._place_parts()

    def _place_parts(self) -> None:
        for at, row in enumerate(self.rows):
            row.setGeometry(1, HEAD + at * ROW, self.width() - 2, ROW)
        self.go.adjustSize()
        self.go.move(self.width() - self.go.width() - 12, self.height() - self.go.height() - 8)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the card, its title, and what follows."""
        painter, tokens = QPainter(self), self._tokens
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(tokens.line2, 1))
        painter.setBrush(tokens.surf)
        box = QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5)
        painter.drawRoundedRect(box, RADIUS_CARD, RADIUS_CARD)
        title = QRectF(14, 0, self.width() - 28, HEAD)
        paint_text(painter, title, "Next, in this order", TextInk(tokens.tx, 13, 600))
        if not self.steps:
            words = "Nothing. Every stage is settled."
            paint_text(painter, title.translated(0, ROW), words, TextInk(tokens.tx2, 12))
        later = [str(one.number) for one in self.steps[MOST:]]
        if later:
            foot = QRectF(14, self.height() - FOOT, self.width() // 2, FOOT)
            words = f"then {', '.join(dict.fromkeys(later))}"
            paint_text(painter, foot, words, TextInk(tokens.tx2, 12))
        painter.end()


class _StepRow(QAbstractButton):
    """One step."""

    def __init__(self, step: NextStep, tokens: Tokens, parent: QWidget) -> None:
        super().__init__(parent)
        self.step, self._tokens = step, tokens
        self.setText(plain_text(f"{step.name}: {step.what}, {step.who}"))
        self.setAccessibleName(self.text())
        self.setToolTip(tip_text(self.text()))
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        self.setAttribute(Qt.WidgetAttribute.WA_Hover)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Enter chooses, as Space does."""
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self.click()
        else:
            super().keyPressEvent(event)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint number, stage, what to do, and who does it."""
        painter, tokens, step = QPainter(self), self._tokens, self.step
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        if self.underMouse() or self.hasFocus():
            painter.fillRect(self.rect(), tokens.accs if self.hasFocus() else tokens.sunk)
        painter.fillRect(0, 0, self.width(), 1, tokens.line)
        paint_disc(painter, QPointF(24, ROW / 2), step.number, tokens, accent=False)
        high, wide = float(ROW), self.width()
        right = QRectF(wide - 84, 0, 70, high)
        paint_text(painter, right, step.who, TextInk(tokens.tx2, 12), right=True)
        named = min(136.0, wide * 0.36)
        paint_text(painter, QRectF(42, 0, named - 8, high), step.name, TextInk(tokens.tx, 12))
        room = QRectF(42 + named, 0, wide - 84 - 42 - named, high)
        paint_text(painter, room, step.what, TextInk(tokens.tx2, 12))
        painter.end()
