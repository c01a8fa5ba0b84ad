"""The wide buttons of Step in: an icon, words, a hint, and the key."""

from __future__ import annotations

from PySide6.QtCore import QRectF, QSize
from PySide6.QtGui import QIcon, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QPushButton, QSizePolicy, QStyle, QStyleOptionButton

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.icons import draw
from smsl_studio.studio.base.paint.ink import Type
from smsl_studio.studio.base.theme import CONTROL_DECISION, Tokens, text_font

SIDE, NARROW_SIDE, ICON, CHIP = 12, 6, 16, 20


class StepInButton(QPushButton):
    """A button 40 pixels high, with words at the left and the key at the right."""

    def __init__(self, words: str, key: str, name: str, tokens: Tokens, hint: str = "") -> None:
        super().__init__(words)
        self._letter, self._icon, self._tokens, self._hint = key, name, tokens, hint
        self._narrow = False
        self.setFixedHeight(CONTROL_DECISION)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setAccessibleName(plain_text(words.rstrip("…")))

    @property
    def _key(self) -> str:
        return "" if self._narrow else self._letter

    def set_narrow(self, narrow: bool) -> None:
        """Leave out the key, where there is little room."""
        if narrow != self._narrow:
            self._narrow = narrow
            self.updateGeometry()
            self.update()

    def set_words(self, words: str, hint: str, name: str) -> None:
        """Give the button other words, another hint and another icon."""
        self._hint, self._icon = hint, name
        self.setText(words)
        self.setAccessibleName(plain_text(words.rstrip("…")))
        self.update()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def sizeHint(self) -> QSize:
        """Wide enough for icon, words and key; 40 pixels high."""
        words = Type(text_font(13, 500)).width(self.text())
        return QSize(round(words) + 2 * SIDE + ICON + 8 + (CHIP + 8 if self._key else 0), 40)

    def minimumSizeHint(self) -> QSize:
        """80 pixels wide, because the words can be shortened."""
        return QSize(80, CONTROL_DECISION)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint icon, words and key on the button of the style."""
        option = QStyleOptionButton()
        self.initStyleOption(option)
        option.text, option.icon = "", QIcon()
        painter = QPainter(self)
        self.style().drawControl(QStyle.ControlElement.CE_PushButton, option, painter, self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        t, middle = self._tokens, self.height() / 2
        ink = t.tx if self.isEnabled() else t.tx3
        side = NARROW_SIDE if self._narrow else SIDE
        draw(painter, self._icon, QRectF(side, middle - 8, ICON, ICON), ink, t.surf)
        right = float(self.width() - side)
        if self._key:
            right -= CHIP
            painter.setPen(QPen(t.line, 1))
            painter.setBrush(t.win)
            box = QRectF(right, middle - CHIP / 2, CHIP, CHIP)
            painter.drawRoundedRect(box.adjusted(0.5, 0.5, -0.5, -0.5), 4, 4)
            Type(text_font(11, 500)).draw(painter, box.center().x(), middle, self._key, t.tx2)
        left = side + ICON + side * 2 / 3
        strong, soft = Type(text_font(13, 500)), Type(text_font(12))
        shown = strong.elided(self.text(), right - (8 if self._key else 0) - left)
        strong.draw_from(painter, left, middle, shown, ink)
        left += strong.width(shown) + 12
        if self._hint and soft.width(self._hint) < right - 8 - left:
            at = right - 8 - soft.width(self._hint)
            soft.draw_from(painter, at, middle, self._hint, t.tx2)
        painter.end()
