"""Legends: the signs of sub-SBs in a drawing, and the signs of a run."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRect, QRectF, QSize, Qt
from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import QWidget

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.legible import one_line, plain_text
from smsl_studio.picture.guards import MEANING
from smsl_studio.picture.sub_marks import mark_words
from smsl_studio.studio.base.paint.guard_sign import DECLARED, HOLDS, MISSES, UNKNOWN, draw_guard
from smsl_studio.studio.base.paint.ink import (
    NO_PEN,
    Type,
    draw_barred,
    draw_sub_mark,
    draw_veil,
    draw_warning,
    faded,
    pen,
)
from smsl_studio.studio.base.theme import Tokens, text_font

ROW = 18
RUN_WORDS = ("active", "running", "path so far", "planned", "pruned")
HELD_BACK, MET, NOT_MET, RISK = "held back, unknown", "needs met", "needs not met", "risky"
RUN_ROW = 22


class Legend(QWidget):
    """Explains the signs rise, fall and mixed of sub-SBs, and the lock of required facts.

    With one sub-SB it names its fact.
    """

    def __init__(self, parent: QWidget, tokens: Tokens) -> None:
        super().__init__(parent)
        self.tokens = tokens
        self._type = Type(text_font(12))
        self._words: tuple[tuple[str, str], ...] = ()
        self.gives_way = False
        """Whether it is not painted, because a state is being drawn below it."""
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)

    def show_branch(self, branch: StateBranch, kinds: set[str]) -> None:
        """Explain the signs of these kinds; without kinds the legend is empty."""
        words = {kind: one_line(text) for kind, text in mark_words(branch, kinds).items()}
        if "guard" in kinds:
            words["guard"] = MEANING
        self._words = tuple(words.items())
        self.setAccessibleName(plain_text("; ".join(text for _, text in self._words)))
        self.resize(self.sizeHint())
        self.update()

    def spare(self, area: QRect) -> None:
        """Paint nothing while it would cover an area of the view; an empty one is never covered."""
        gives_way = self.geometry().intersects(area)
        if gives_way != self.gives_way:
            self.gives_way = gives_way
            self.update()

    @property
    def empty(self) -> bool:
        """Whether there is nothing to explain."""
        return not self._words

    def sizeHint(self) -> QSize:
        """Wide enough for the longest row."""
        width = max((self._type.width(text) for _, text in self._words), default=0.0)
        return QSize(int(width) + 24, ROW * len(self._words))

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint a sign and its words in each row, on a background that half hides the drawing."""
        if self.gives_way:
            return
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        draw_veil(painter, self.rect(), self.tokens)
        for i, (kind, text) in enumerate(self._words):
            y = i * ROW + ROW / 2
            if kind == "guard":
                draw_guard(painter, 6.0, y, DECLARED, self.tokens)
            else:
                draw_sub_mark(painter, 6.0, y, kind, self.tokens.acc, self.tokens.canvas)
            self._type.draw_from(painter, 18.0, y, text, self.tokens.tx2)
        painter.end()


class RunLegend(QWidget):
    """Explains the signs of a run: active, running, path so far, planned, pruned.

    If operations require facts it also explains the locks and what is held back, and the risky sign
    if there is one.
    """

    empty = False

    def __init__(self, parent: QWidget, tokens: Tokens) -> None:
        super().__init__(parent)
        self.tokens = tokens
        self._type = Type(text_font(12))
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.words: tuple[str, ...] = ()
        self.show_kinds(guarded=False, risky=False)

    def show_kinds(self, guarded: bool, risky: bool) -> bool:
        """Explain the signs that this SB can show; returns whether the legend changed."""
        words: tuple[str, ...] = RUN_WORDS
        words += (HELD_BACK, MET, NOT_MET) if guarded else ()
        words += (RISK,) if risky else ()
        changed = words != self.words
        if changed:
            self.words = words
            self.setAccessibleName(plain_text("Legend: " + ", ".join(words)))
            self.resize(self.sizeHint())
            self.update()
        return changed

    def sizeHint(self) -> QSize:
        """Wide enough for the longest row."""
        width = max(self._type.width(text) for text in self.words)
        return QSize(int(width) + 42, RUN_ROW * len(self.words))

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint a sign and its words in each row, on a background that half hides the drawing."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        draw_veil(painter, self.rect(), self.tokens)
        for i, text in enumerate(self.words):
            y = i * RUN_ROW + RUN_ROW / 2
            self._sign(painter, text, y)
            self._type.draw_from(painter, 36.0, y, text, self.tokens.tx2)
        painter.end()

    def _sign(self, painter: QPainter, text: str, y: float) -> None:
        tokens = self.tokens
        start, end = QPointF(1.0, y), QPointF(27.0, y)
        if text == "active":
            painter.setPen(NO_PEN)
            painter.setBrush(tokens.acc)
            painter.drawRoundedRect(QRectF(1.0, y - 5.0, 26.0, 10.0), 3.0, 3.0)
        elif text == "running":
            painter.setPen(pen(tokens.accl, 5.0))
            painter.drawLine(start, end)
            painter.setPen(pen(tokens.acc, 5.0))
            painter.drawLine(start, QPointF(14.0, y))
            painter.setPen(pen(tokens.acc, 2.4))
            painter.setBrush(tokens.surf)
            painter.drawEllipse(QPointF(14.0, y), 4.0, 4.0)
        elif text == "path so far":
            painter.setPen(pen(faded(tokens.acc, 0.16), 9.0))
            painter.drawLine(start, end)
            painter.setPen(pen(tokens.acc, 2.4))
            painter.drawLine(start, end)
        elif text == "planned":
            painter.setPen(pen(tokens.acc, 1.6, (4.0, 4.0)))
            painter.drawLine(start, end)
        elif text == HELD_BACK:
            painter.setPen(pen(tokens.edge, 1.6, (6.0, 3.0)))
            painter.drawLine(start, end)
            draw_guard(painter, 14.0, y, UNKNOWN, tokens)
        elif text in (MET, NOT_MET):
            draw_guard(painter, 14.0, y, HOLDS if text == MET else MISSES, tokens)
        elif text == RISK:
            painter.setPen(pen(tokens.risk, 2.0))
            painter.drawLine(start, end)
            draw_warning(painter, 14.0, y, 12.0, tokens)
        else:
            painter.setPen(pen(tokens.edge, 1.6, (2.0, 4.0)))
            painter.drawLine(start, end)
            draw_barred(painter, 14.0, y, 5.5, tokens)
