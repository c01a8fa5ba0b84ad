"""A small drawing of what a version would make of the element of a conflict."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPolygonF
from PySide6.QtWidgets import QSizePolicy, QWidget

from smsl_studio.blueprint.merge import ABSENT, Conflict, Side
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.paint.ink import NO_PEN, Type, draw_barred, pen
from smsl_studio.studio.base.theme import Tokens, mono_font, text_font
from smsl_studio.studio.features.merge.conflict_card import SIDES, heading_of, value_words
from smsl_studio.studio.features.merge.open_merge import WORDS

WIDE, HIGH = 186, 88
BOX, ROW = 52.0, 22.0
SHORT, PREFIX = "State_", "Op_"


class PreviewSketch(QWidget):
    """Draws the element as one version has it: a target with its arrow, else the element with its
    value. What the other versions have and this one has not is dotted."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._tokens = tokens
        self._shown: tuple[Conflict, Side] | None = None
        self._name, self._small = Type(mono_font(11, 500)), Type(text_font(11))
        self.setFixedSize(WIDE, HIGH)
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        self.setAccessibleName("Preview as a drawing")

    def show_choice(self, conflict: Conflict | None, side: Side | None) -> None:
        """Show what this version has; None shows nothing."""
        self._shown = None if conflict is None or side is None else (conflict, side)
        self.setAccessibleDescription(plain_text(self.words))
        self.update()

    @property
    def words(self) -> str:
        """What is drawn, in words; empty for nothing."""
        if self._shown is None:
            return ""
        conflict, side = self._shown
        what, where = heading_of(conflict)
        return f"{WORDS[side]}: {what}, {where}, {value_words(conflict, side)}"

    @property
    def targets(self) -> tuple[str, ...]:
        """The states to which arrows lead: that of the version first, then those of the others."""
        if self._shown is None or not is_target(self._shown[0]):
            return ()
        conflict, side = self._shown
        values = [getattr(conflict, one) for one in (side, *SIDES)]
        return tuple(dict.fromkeys(one for one in values if one is not ABSENT and one))

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def sizeHint(self) -> QSize:
        """Always the same, so that nothing moves under the pointer."""
        return QSize(WIDE, HIGH)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the drawing."""
        if self._shown is None:
            return
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        if is_target(self._shown[0]):
            self._paint_targets(painter, *self._shown)
        else:
            self._paint_value(painter, *self._shown)
        painter.end()

    def _paint_targets(self, painter: QPainter, conflict: Conflict, side: Side) -> None:
        t, own = self._tokens, getattr(conflict, side)
        source = QRectF(2, HIGH / 2 - ROW / 2, BOX, ROW)
        self._box(painter, source, conflict.path[1], t.nl, t.tx)
        found = self.targets[:3]
        for at, target in enumerate(found):
            y = HIGH * (at + 1) / (len(found) + 1) - ROW / 2
            box = QRectF(WIDE - BOX - 2, y, BOX, ROW)
            taken = target == own
            start = QPointF(source.right(), source.center().y())
            end = QPointF(box.left(), box.center().y())
            line = t.acc if taken else t.edge
            painter.setPen(pen(line, 2.0) if taken else pen(line, 1.3, (2.0, 3.0)))
            painter.drawLine(start, end)
            self._box(painter, box, target, t.nl if taken else t.line2, t.tx if taken else t.tx3)
            middle = (start + end) / 2
            if taken:
                self._head(painter, end, line)
                name = conflict.path[2].removeprefix(PREFIX) or conflict.path[2]
                shown = self._small.elided(name, WIDE - 2 * BOX - 14)
                above = min(start.y(), end.y()) - 10
                self._small.draw(painter, middle.x() - 2, above, shown, t.acc)
            else:
                draw_barred(painter, middle.x(), middle.y(), 6.0, t)

    def _paint_value(self, painter: QPainter, conflict: Conflict, side: Side) -> None:
        t = self._tokens
        gone = getattr(conflict, side) is ABSENT
        what, _ = heading_of(conflict)
        name, _, field = what.partition(", ")
        box = QRectF(4, 14, WIDE - 8, HIGH - 28)
        painter.setPen(pen(t.edge, 1.3, (3.0, 2.0)) if gone else pen(t.acc, 1.6))
        painter.setBrush(t.surf)
        painter.drawRoundedRect(box, 7, 7)
        strong = Type(text_font(12, 600))
        room, middle = box.width() - 16, box.center()
        strong.draw(painter, middle.x(), middle.y() - 11, strong.elided(name, room), t.tx)
        value = value_words(conflict, side)
        words = f"{field}: {value}" if field else value
        shown = self._small.elided(words, room)
        self._small.draw(painter, middle.x(), middle.y() + 9, shown, t.tx3 if gone else t.acc)

    def _box(self, painter: QPainter, box: QRectF, name: str, line: QColor, ink: QColor) -> None:
        painter.setPen(pen(line, 1.2))
        painter.setBrush(self._tokens.surf)
        painter.drawRoundedRect(box, 5, 5)
        short = name.removeprefix(SHORT) or name
        shown = self._name.elided(short, box.width() - 8)
        self._name.draw(painter, box.center().x(), box.center().y(), shown, ink)

    @staticmethod
    def _head(painter: QPainter, tip: QPointF, colour: QColor) -> None:
        painter.setPen(NO_PEN)
        painter.setBrush(colour)
        painter.drawPolygon(QPolygonF([tip, tip + QPointF(-8, -3.6), tip + QPointF(-8, 3.6)]))
        painter.setBrush(Qt.BrushStyle.NoBrush)


def is_target(conflict: Conflict) -> bool:
    """Whether a conflict is about where an operation leads."""
    path = conflict.path
    plain = len(path) == 3 and not path[1].startswith("_") and path[1] != "HEADER"
    return plain and not conflict.about_name
