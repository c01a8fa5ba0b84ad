"""A state of the partial view: its box, and the words below it."""

from __future__ import annotations

from dataclasses import replace

from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QMouseEvent, QPainter, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.legible import plain_text
from smsl_studio.picture.levels import FULL_SIZE
from smsl_studio.picture.picture import Face
from smsl_studio.studio.base.paint.ink import Ink, Type
from smsl_studio.studio.base.paint.node_paint import NodeLook, full_width, paint_node
from smsl_studio.studio.base.theme import text_font
from smsl_studio.studio.base.tips import tip_text

AROUND = 26
"""Pixels around the box for the glow and the ring."""
BELOW = 38
"""Pixels for two lines of words below the box."""


class StateSpot(QWidget):
    """Shows one state; ``place`` moves the middle of its box to a point."""

    pressed = Signal(str)
    """str: the person clicked on this state."""

    def __init__(self, ink: Ink, parent: QWidget) -> None:
        super().__init__(parent)
        self._ink = ink
        self._face: Face | None = None
        self._look = NodeLook()
        self._strong = self._soft = ""
        self._wide = FULL_SIZE[0]
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)

    @property
    def wide(self) -> float:
        """The width of the box (pixels)."""
        return self._wide

    def set_ink(self, ink: Ink) -> None:
        """Use the fonts and colours of another theme."""
        self._ink = ink
        self.update()

    def show_state(
        self,
        branch: StateBranch,
        face: Face,
        look: NodeLook,
        role: str,
        most: float,
        words: tuple[str, str] = ("", ""),
    ) -> None:
        """Show a state at most ``most`` pixels wide.

        ``words`` are two lines below it, the first one bold. ``role`` is its role for assistive
        tools.
        """
        self._wide = min(full_width(face, self._ink), most)
        # The sign of an initial state is left out, because arrows arrive at its place here.
        face = replace(face, initial=False)
        self._face, self._look, (self._strong, self._soft) = face, look, words
        facts = [f"{branch.fact_name(digit)}: {chip.text}" for digit, chip in enumerate(face.chips)]
        title = [face.title] if face.title else []
        self.setAccessibleName(plain_text(", ".join([f"{role} state {face.name}", *title, *facts])))
        told = [face.name, *title, *facts, "A click chooses what is otherwise there"]
        self.setToolTip(tip_text("\n".join(told)))
        if self._strong or self._soft:
            # The words below say it already.
            self._face = replace(face, title="")
        self.resize(self.sizeHint())
        self.update()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Tell that the state was clicked."""
        if self._face is not None:
            self.pressed.emit(self._face.name)

    def place(self, centre: QPointF) -> None:
        """Move the middle of the box to a point of the parent."""
        self.move(round(centre.x() - self.width() / 2), round(centre.y() - AROUND - 27))

    def sizeHint(self) -> QSize:
        """The size of the box with the room around it and the words below."""
        return QSize(round(self._wide) + 2 * AROUND, round(FULL_SIZE[1]) + 2 * AROUND + BELOW)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the box and the words below it."""
        if self._face is None:
            return
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.translate(self.width() / 2, AROUND + FULL_SIZE[1] / 2)
        paint_node(painter, self._face, self._wide, False, self._look, self._ink)
        painter.resetTransform()
        y = AROUND + FULL_SIZE[1] + 16.0
        t = self._ink.tokens
        for words, kind, ink in (
            (self._strong, Type(text_font(12, 600)), t.tx),
            (self._soft, Type(text_font(12)), t.tx2),
        ):
            if words:
                room = QRectF(4, y - 9, self.width() - 8, 18)
                painter.setFont(kind.font)
                painter.setPen(ink)
                shown = kind.elided(words, room.width())
                painter.drawText(room, Qt.AlignmentFlag.AlignCenter, shown)
                y += 17
        painter.end()


def clock(seconds: float) -> str:
    """Minutes and seconds, such as 00:41."""
    whole = int(seconds)
    return f"{whole // 60:02d}:{whole % 60:02d}"
