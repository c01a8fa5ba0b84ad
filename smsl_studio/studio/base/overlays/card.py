"""Card and IconButton: the background and the buttons of floating widgets."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QEnterEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import (
    QAbstractButton,
    QApplication,
    QGraphicsDropShadowEffect,
    QLabel,
    QWidget,
)

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.icons import draw
from smsl_studio.studio.base.paint.ink import NO_BRUSH, NO_PEN, faded
from smsl_studio.studio.base.tab_order import go_on
from smsl_studio.studio.base.theme import RADIUS_CONTROL, Tokens, text_font
from smsl_studio.studio.base.tips import tip_text

ICON, GAP = 16.0, 8.0
"""The size of an icon, and the space to the left of an icon before words (pixels)."""


class Card(QWidget):
    """A floating background with a thin border and rounded corners."""

    def __init__(self, parent: QWidget, tokens: Tokens, radius: float = RADIUS_CONTROL) -> None:
        super().__init__(parent)
        self.tokens = tokens
        self.radius = radius
        self.setAttribute(Qt.WidgetAttribute.WA_NoMousePropagation)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)

    def float_up(self) -> None:
        """Give the card a soft shadow."""
        shadow = QGraphicsDropShadowEffect(self)
        shadow.setBlurRadius(22.0)
        shadow.setOffset(0.0, 4.0)
        shadow.setColor(QColor(10, 16, 28, 120 if self.tokens.dark else 46))
        self.setGraphicsEffect(shadow)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme, also for the icon buttons on the card."""
        self.tokens = tokens
        for child in self.findChildren(IconButton):
            child.tokens = tokens
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the background and its border."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(self.tokens.line, 1.0))
        painter.setBrush(self.tokens.surf)
        rect = QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5)
        painter.drawRoundedRect(rect, self.radius, self.radius)
        painter.end()


class PassingCard(Card):
    """A card for one answer. After it closed it emits ``closed`` and is deleted."""

    closed = Signal()

    def __init__(self, parent: QWidget, tokens: Tokens, radius: float) -> None:
        super().__init__(parent, tokens, radius)
        self._closing = False
        self.float_up()

    @property
    def is_open(self) -> bool:
        """Whether the card is shown and waits for its answer."""
        return not self._closing and not self.isHidden()

    def settle(self) -> None:
        """Use the text that was typed into the card, because the person leaves it or saves.

        A card without a text does nothing here.
        """

    def close_field(self) -> None:
        """Close the card; a second call does nothing.

        If the card has the keyboard focus, the focus returns to the widget below.
        """
        if not self._closing:
            self._closing = True
            focus, below = QApplication.focusWidget(), self.parentWidget()
            if below is not None and focus is not None and self.isAncestorOf(focus):
                below.setFocus()
            self.hide()
            self.closed.emit()
            self.deleteLater()

    def leave(self, forward: bool = True) -> None:
        """Close the card as Esc does, and go on as Tab does, or back as Shift+Tab does."""
        below = self.parentWidget()
        self.close_field()
        if below is not None:
            go_on(below, forward)


def tint(label: QLabel, colour: QColor) -> None:
    """Set the colour of a label, independent of the window's style sheet."""
    label.setStyleSheet(f"color: {colour.name()}; background: transparent;")


class IconButton(QAbstractButton):
    """A button with a line icon, with words, or with both; its name is also its tooltip."""

    def __init__(self, parent: QWidget, tokens: Tokens, icon: str, name: str) -> None:
        super().__init__(parent)
        self.tokens = tokens
        self._icon = icon
        self.accent = False
        self._inside = False
        self.setToolTip(tip_text(name))
        self.setAccessibleName(plain_text(name))
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.setCursor(Qt.CursorShape.PointingHandCursor)

    def sizeHint(self) -> QSize:
        """30 by 30 pixels."""
        return QSize(30, 30)

    def enterEvent(self, event: QEnterEvent) -> None:
        """Highlight the button while the pointer is on it."""
        self._inside = True
        self.update()

    def leaveEvent(self, event: QEvent) -> None:
        """Remove the highlight."""
        self._inside = False
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the icon or the words, with a highlight under the pointer."""
        tokens = self.tokens
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        rect = QRectF(self.rect())
        if self._inside or self.isDown():
            painter.setPen(NO_PEN)
            painter.setBrush(tokens.sunk if not self.isDown() else tokens.accs)
            painter.drawRoundedRect(rect.adjusted(2, 2, -2, -2), 5, 5)
        colour = tokens.acc if self.accent else tokens.tx2
        if not self.isEnabled():
            colour = faded(colour, 0.4)
        painter.setBrush(NO_BRUSH)
        box = QRectF(0, 0, ICON, ICON)
        box.moveCenter(rect.center())
        if self.text() and self._icon:
            box.moveLeft(GAP)
            rect.setLeft(box.right())
        if self._icon:
            draw(painter, self._icon, box, colour, tokens.surf)
        if self.text():
            painter.setFont(text_font(13, 500))
            painter.setPen(colour)
            painter.drawText(rect, Qt.AlignmentFlag.AlignCenter, plain_text(self.text()))
        painter.end()
