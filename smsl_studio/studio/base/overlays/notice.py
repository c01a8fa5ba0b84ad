"""Messages on the canvas: a banner at the top, a sentence at the pointer, a hint if it is empty."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QRectF, Qt, Signal
from PySide6.QtGui import QMouseEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QApplication, QHBoxLayout, QPushButton, QVBoxLayout, QWidget

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.announcement import announce
from smsl_studio.studio.base.controls import Label
from smsl_studio.studio.base.overlays.card import Card, tint
from smsl_studio.studio.base.theme import Tokens, text_font


class Banner(QWidget):
    """A box across the top, such as "The drawing has moved on since this run began"."""

    def __init__(self, parent: QWidget, tokens: Tokens) -> None:
        super().__init__(parent)
        self.tokens = tokens
        self._text = Label("", self)
        self._text.setFont(text_font(12, 500))
        layout = QHBoxLayout(self)
        layout.setContentsMargins(14, 5, 14, 5)
        layout.addWidget(self._text)
        self._text.setWordWrap(True)
        self.set_tokens(tokens)
        self.hide()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.tokens = tokens
        tint(self._text, tokens.risk)
        self.update()

    def show_text(self, text: str) -> None:
        """Show a text; empty hides the banner."""
        self._text.setText(text)
        self.setAccessibleName(plain_text(text))
        self.setVisible(bool(text))

    def fit(self, room: int) -> None:
        """Make the banner as wide as its text, at most ``room`` pixels; a longer text wraps."""
        metrics = self._text.fontMetrics()
        lines = self._text.text().split("\n")
        wide = max(metrics.horizontalAdvance(line) for line in lines) + 32
        wide = max(min(wide, room), 60)
        self.resize(wide, self._text.heightForWidth(wide - 28) + 10)

    @property
    def text(self) -> str:
        """The present text."""
        return self._text.text()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the background in the colours of a risk."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(self.tokens.risk, 1.0))
        painter.setBrush(self.tokens.risks)
        painter.drawRoundedRect(QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5), 6, 6)
        painter.end()


class PointerNote(Card):
    """A short sentence beside the pointer."""

    placed = Signal()
    """A sentence is shown and has its place, so other messages may have to make room."""

    def __init__(self, parent: QWidget, tokens: Tokens) -> None:
        super().__init__(parent, tokens)
        self.float_up()
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self._label = Label("", self)
        self._label.setFont(text_font(12))
        self._label.setWordWrap(False)
        layout = QHBoxLayout(self)
        layout.setContentsMargins(10, 5, 10, 5)
        layout.addWidget(self._label)
        self.hide()

    @property
    def text(self) -> str:
        """The sentence that is shown; empty if there is none."""
        return self._label.text() if not self.isHidden() else ""

    def say(self, text: str) -> None:
        """Show a sentence above all other widgets of the canvas."""
        self._label.setText(text)
        tint(self._label, self.tokens.tx)
        self.setAccessibleName(plain_text(text))
        self.adjustSize()
        self.setVisible(True)
        self.raise_()
        announce(self, text)


class EmptyHint(QWidget):
    """The hint on an SB without states, with a button that opens a sample."""

    sample_wanted = Signal()

    def __init__(self, parent: QWidget, below: QWidget, tokens: Tokens) -> None:
        """``below`` is the drawing, which gets what the mouse does beside the button."""
        super().__init__(parent)
        self.tokens, self._below = tokens, below
        self._label = Label("Double-click or press Enter to add the first state", self)
        self._label.setFont(text_font(14))
        self._label.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self._label.setWordWrap(True)
        # A double click on the words must reach the canvas below, see ``event``.
        self._label.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.sample = QPushButton("Open sample", self)
        self.sample.setCursor(Qt.CursorShape.PointingHandCursor)
        self.sample.clicked.connect(self.sample_wanted)
        self._layout = QVBoxLayout(self)
        self._layout.setSpacing(12)
        self._layout.addWidget(self._label)
        self._layout.addWidget(self.sample, 0, Qt.AlignmentFlag.AlignHCenter)
        self.set_tokens(tokens)
        self.hide()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.tokens = tokens
        tint(self._label, tokens.tx2)

    def event(self, event: QEvent) -> bool:
        """Hand clicks and moves of the mouse to the drawing below."""
        if isinstance(event, QMouseEvent):
            at = self._below.mapFromGlobal(event.globalPosition())
            QApplication.sendEvent(
                self._below,
                QMouseEvent(
                    event.type(), at, event.globalPosition(), event.button(), event.buttons(),
                    event.modifiers(),
                ),
            )  # fmt: skip
            return True
        return super().event(event)

    def fit(self, room: int) -> None:
        """Make the hint as wide as its words, at most ``room`` pixels; then the words wrap."""
        # Before the style sheet its letters are smaller.
        self._label.ensurePolished()
        around, gap = self._layout.contentsMargins(), self._layout.spacing()
        words = self._label.fontMetrics().horizontalAdvance(self._label.text()) + 4
        wide = max(min(words, room - around.left() - around.right()), 1)
        high = self._label.heightForWidth(wide) + gap + self.sample.sizeHint().height()
        self.resize(wide + around.left() + around.right(), high + around.top() + around.bottom())
