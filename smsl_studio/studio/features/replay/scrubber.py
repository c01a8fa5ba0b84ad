"""The scrubber: a recorded run as one line with marks for what happened."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable

from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QKeyEvent, QMouseEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from smsl_studio.front.views.event_marks import COMMIT, FAULT, HELD, KINDS, PERSON
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.theme import Tokens

HIGH, EDGE, LINE = 32, 8.0, 4.0
"""Height, free space at both ends, and thickness of the line (pixels)."""
SIZES = {COMMIT: 4.0, PERSON: 6.0, FAULT: 8.0, HELD: 10.0}
"""Height of each kind of mark (pixels): the more serious, the taller. The colours differ too."""
STEP = 0.01
"""The share of the run by which an arrow key moves."""


class Scrubber(QWidget):
    """A slider over time.

    A press, a drag, arrows, Home and End emit ``time_wanted`` (simulated seconds).
    """

    time_wanted = Signal(float)

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._tokens = tokens
        self._time = self._end = 0.0
        self._marks: dict[str, list[float]] = {}
        self.setFixedHeight(HIGH)
        self.setMinimumWidth(80)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setAccessibleName("Moment of the run")
        self.setToolTip("Drag to a moment. Tall marks: held; then faults, people, commits")

    def sizeHint(self) -> QSize:
        """320 pixels wide."""
        return QSize(320, HIGH)

    def show_run(self, end: float, marks: Iterable[tuple[float, str]]) -> None:
        """Show another run: its end (simulated seconds), and its marks in order of time."""
        self._end, self._marks = end, {}
        for time, kind in marks:
            self._marks.setdefault(kind, []).append(time)
        self.update()

    def show_time(self, time: float) -> None:
        """Show this moment (simulated seconds)."""
        if time != self._time:
            self._time = time
            self.setAccessibleDescription(plain_text(f"{time:.2f} of {self._end:.2f} s"))
            self.update()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Emit the time under the pointer."""
        if event.button() == Qt.MouseButton.LeftButton:
            self._go(event.position())

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Emit the time under the pointer during a drag."""
        if event.buttons() & Qt.MouseButton.LeftButton:
            self._go(event.position())

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Arrows and page keys move by a part of the run, Home and End to its ends."""
        by = {Qt.Key.Key_Left: -STEP, Qt.Key.Key_Right: STEP, Qt.Key.Key_PageUp: -10 * STEP,
              Qt.Key.Key_PageDown: 10 * STEP, Qt.Key.Key_Home: -1.0, Qt.Key.Key_End: 1.0,
              }.get(Qt.Key(event.key()))  # fmt: skip
        if by is None:
            super().keyPressEvent(event)
            return
        self.time_wanted.emit(min(max(self._time + by * self._end, 0.0), self._end))

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the line, the marks and the present moment."""
        t, painter = self._tokens, QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        middle, here = self.height() - 11.0, self._x(self._time)
        line = QRectF(EDGE, middle - LINE / 2, self.width() - 2 * EDGE, LINE)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(t.line2)
        painter.drawRoundedRect(line, LINE / 2, LINE / 2)
        painter.setBrush(t.acc)
        line.setRight(here)
        painter.drawRoundedRect(line, LINE / 2, LINE / 2)
        for kind in KINDS:
            self._paint_marks(painter, kind, middle)
        painter.setPen(QPen(t.surf, 2))
        painter.setBrush(t.acc)
        painter.drawEllipse(QPointF(here, middle), 7, 7)
        if self.hasFocus():
            painter.setPen(QPen(t.acc, 2))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawEllipse(QPointF(here, middle), 9.5, 9.5)
        painter.end()

    def _paint_marks(self, painter: QPainter, kind: str, middle: float) -> None:
        """Paint at most one mark of a kind on each pixel."""
        times = self._marks.get(kind, [])
        painter.setPen(QPen(self._colour(kind), 2))
        at = 0
        while at < len(times):
            x = round(self._x(times[at]))
            painter.drawLine(QPointF(x, middle - 5 - SIZES[kind]), QPointF(x, middle - 5))
            at = max(bisect_left(times, self._time_at(x + 1.0)), at + 1)

    def _colour(self, kind: str) -> QColor:
        t = self._tokens
        return {COMMIT: t.tx3, PERSON: t.acc, FAULT: t.risk, HELD: t.bad}[kind]

    def _x(self, time: float) -> float:
        return EDGE + (self.width() - 2 * EDGE) * (time / self._end if self._end else 0.0)

    def _time_at(self, x: float) -> float:
        return self._end * (x - EDGE) / max(self.width() - 2 * EDGE, 1.0)

    def _go(self, at: QPointF) -> None:
        self.time_wanted.emit(min(max(self._time_at(at.x()), 0.0), self._end))
