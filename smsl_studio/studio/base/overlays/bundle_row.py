"""BundleRow: one operation of a bundle, as a line of its card that can be clicked."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import QEvent, QRectF, QSize, Qt
from PySide6.QtGui import QEnterEvent, QPainter, QPaintEvent, QTransform
from PySide6.QtWidgets import QAbstractButton, QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.icons import ACTOR_ICON, draw
from smsl_studio.studio.base.paint.ink import NO_PEN, Type
from smsl_studio.studio.base.theme import Tokens, text_font
from smsl_studio.studio.base.tips import tip_text

HIGH, SIDE, GAP = 24, 16.0, 10.0
WIDEST = 300.0
"""The room for a name; a longer one is cut in its middle and has a tooltip (pixels)."""


@dataclass(frozen=True)
class BundleLine:
    """An operation of a bundle: its address and name, and who acts (empty if nobody says so).

    ``back`` is true if it leads against the direction of the first operation.
    """

    address: Address
    name: str
    actor: str = ""
    back: bool = False


class BundleRow(QAbstractButton):
    """An arrow for the direction, the name of the operation, and a sign for who acts."""

    def __init__(self, parent: QWidget, tokens: Tokens, line: BundleLine) -> None:
        super().__init__(parent)
        self.tokens, self.line = tokens, line
        self._type = Type(text_font(12))
        self._shown = self._type.elided(line.name, WIDEST)
        self._inside = False
        whole = line.address.operation
        who = f", {line.actor}" if line.actor else ""
        self.setAccessibleName(plain_text(f"{whole} from {line.address.state}{who}"))
        self.setToolTip(tip_text(whole))
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.setCursor(Qt.CursorShape.PointingHandCursor)

    def sizeHint(self) -> QSize:
        """Room for the arrow, the name and the sign."""
        return QSize(round(self._type.width(self._shown) + 2 * SIDE + 4 * GAP), HIGH)

    def enterEvent(self, event: QEnterEvent) -> None:
        """Highlight the row while the pointer is on it."""
        self._inside = True
        self.update()

    def leaveEvent(self, event: QEvent) -> None:
        """Remove the highlight."""
        self._inside = False
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the row, with a ground below the pointer or the keyboard focus."""
        tokens, painter = self.tokens, QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        if self._inside or self.hasFocus():
            painter.setPen(NO_PEN)
            painter.setBrush(tokens.accs)
            painter.drawRoundedRect(QRectF(self.rect()).adjusted(4, 0, -4, 0), 4.0, 4.0)
        middle, half = self.height() / 2, SIDE / 2 - 1.0
        arrow = QRectF(GAP, middle - half, 2 * half, 2 * half)
        painter.save()
        if self.line.back:
            x = arrow.center().x()
            painter.setTransform(QTransform(-1, 0, 0, 1, 2 * x, 0), combine=True)
        draw(painter, "arrow", arrow, tokens.tx2, tokens.surf)
        painter.restore()
        self._type.draw_from(painter, SIDE + 2 * GAP, middle, self._shown, tokens.tx)
        if self.line.actor:
            icon = ACTOR_ICON.get(self.line.actor, "robot")
            right = QRectF(self.width() - SIDE - GAP, middle - SIDE / 2, SIDE, SIDE)
            draw(painter, icon, right, tokens.tx2, tokens.surf)
        painter.end()
