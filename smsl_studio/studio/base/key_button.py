"""A button that also shows its shortcut."""

from __future__ import annotations

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import (
    QColor,
    QFont,
    QFontMetricsF,
    QIcon,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
)
from PySide6.QtWidgets import QPushButton, QSizePolicy, QStyle, QStyleOptionButton

from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.icons import draw
from smsl_studio.studio.base.theme import CONTROL_DECISION, Tokens, text_font

ICON, GAP, CHIP = 16, 8, 20


class KeyButton(QPushButton):
    """A button with icon, word and shortcut. ``role`` is plain (empty), ``primary`` or ``stop``."""

    def __init__(
        self,
        words: str,
        key: str,
        name: str,
        role: str,
        tokens: Tokens,
    ) -> None:
        super().__init__(words)
        self._key, self._icon, self._role, self._tokens = key, name, role, tokens
        self._short = self._bare = self._worded = False
        self.setProperty("role", role)
        self.setFixedHeight(CONTROL_DECISION)
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        self.setAccessibleName(plain_text(words))

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Ignore the second click of a double click on Stop.

        Stop takes the place of Run when a run begins. A double click on Run would stop it at once.
        A double click on Stop itself stops with its first click.
        """
        if self._role != "stop":
            super().mouseDoubleClickEvent(event)

    def set_words(self, words: str, key: str, name: str) -> None:
        """Give the button other words, another key and another icon."""
        self._key, self._icon = key, name
        self.setText(words)
        self.setAccessibleName(plain_text(words))
        self.updateGeometry()
        self.update()

    def set_short(self, short: bool, bare: bool = False, worded: bool = False) -> None:
        """Show only icon and key, where there is little room; ``bare`` shows the icon alone.

        ``worded`` shows the words in place of the key, where these two alone say too little.
        """
        if (short, bare, worded) != (self._short, self._bare, self._worded):
            self._short, self._bare, self._worded = short, bare, worded
            self.setMinimumWidth(0)
            self.updateGeometry()
            self.update()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def sizeHint(self) -> QSize:
        """Wide enough for icon, word and key; the height of a decision button."""
        return QSize(round(self._wide()) + 26, CONTROL_DECISION)

    def minimumSizeHint(self) -> QSize:
        """The same as ``sizeHint``: nothing of the button may be cut."""
        return self.sizeHint()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint icon, word and key on the button of the style."""
        option = QStyleOptionButton()
        self.initStyleOption(option)
        option.text, option.icon = "", QIcon()
        painter = QPainter(self)
        self.style().drawControl(QStyle.ControlElement.CE_PushButton, option, painter, self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        ink, paper = self._inks()
        left, middle = (self.width() - self._wide()) / 2, self.height() / 2
        draw(painter, self._icon, QRectF(left, middle - ICON / 2, ICON, ICON), ink, paper)
        left += ICON + GAP
        painter.setPen(ink)
        painter.setFont(self._font())
        if not self._short or (self._worded and not self._bare):
            wide = QFontMetricsF(self._font()).horizontalAdvance(self.text())
            room = QRectF(left, 0, wide + 1, self.height())
            painter.drawText(room, Qt.AlignmentFlag.AlignVCenter, plain_text(self.text()))
            left += wide + GAP
        if not self._bare and not (self._short and self._worded):
            self._paint_key(painter, QRectF(left, middle - CHIP / 2, self._chip(), CHIP))
        painter.end()

    def _paint_key(self, painter: QPainter, box: QRectF) -> None:
        ink, _ = self._inks()
        edge, fill = QColor(ink), QColor(ink)
        edge.setAlphaF(0.0 if self._role == "stop" else 0.6 if self._role else 0.25)
        fill.setAlphaF({"stop": 0.2, "primary": 0.1}.get(self._role, 0.03))
        painter.setPen(QPen(edge, 1) if edge.alpha() else Qt.PenStyle.NoPen)
        painter.setBrush(fill)
        painter.drawRoundedRect(box.adjusted(0.5, 0.5, -0.5, -0.5), 4, 4)
        painter.setPen(ink)
        painter.setFont(text_font(11, 500))
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, plain_text(self._key))

    def _inks(self) -> tuple[QColor, QColor]:
        tokens = self._tokens
        if self._role and not self.isEnabled():
            return tokens.tx3, tokens.sunk
        if self._role == "stop":
            return QColor("white"), tokens.stop
        return (tokens.onacc, tokens.acc) if self._role else (tokens.tx, tokens.surf)

    def _font(self) -> QFont:
        return (
            text_font(14, 700)
            if self._role == "stop"
            else text_font(13, 600 if self._role else 500)
        )

    def _chip(self) -> float:
        return QFontMetricsF(text_font(11, 500)).horizontalAdvance(self._key) + 12

    def _wide(self) -> float:
        if self._bare:
            return ICON
        if self._short and not self._worded:
            return ICON + GAP + self._chip()
        wide = QFontMetricsF(self._font()).horizontalAdvance(self.text())
        if self._short:
            return ICON + GAP + wide
        return ICON + GAP + wide + GAP + self._chip()


def command_button(word: str, role: str, tokens: Tokens) -> KeyButton:
    """The button of a supervisor's command, with label, key and icon of its row."""
    row = COMMANDS[word]
    return KeyButton(row.label, row.key, row.icon, role, tokens)
