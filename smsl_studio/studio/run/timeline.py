"""The timeline: states, operations and facts over simulated time, in lanes.

The lanes are drawn by one item, so that a long run costs what is visible and no more. The wheel
zooms in time at the cursor, a drag pans, a double click shows all again and follows the run.
"""

from __future__ import annotations

from dataclasses import dataclass

import pyqtgraph as pg
from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPen
from PySide6.QtWidgets import QFrame, QScrollArea, QVBoxLayout, QWidget

from smsl_studio.studio.run.story import Span
from smsl_studio.studio.theme import Tokens, mono_font, text_font

LANE = 22
AXIS = 26
LABELS = 108


@dataclass(frozen=True)
class Lane:
    """One row: its label, its spans, and how they look (state, operation or fact)."""

    label: str
    kind: str
    spans: tuple[Span, ...]


class Timeline(QScrollArea):
    """Lanes over time. ``show_lanes`` replaces them; the view follows the run until it is moved."""

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWidgetResizable(True)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setAccessibleName("Timeline")
        self.setToolTip("The wheel zooms in time, a drag pans, a double click shows all")
        inner = QWidget()
        column = QVBoxLayout(inner)
        column.setContentsMargins(0, 0, 8, 0)
        self._box = _TimeBox()
        self._box.moved.connect(self._stop_following)
        self._box.reset.connect(self.follow)
        self._plot = pg.PlotWidget(viewBox=self._box)
        self._plot.setFrameShape(QFrame.Shape.NoFrame)
        self._plot.hideButtons()
        self._plot.setMenuEnabled(False)
        self._plot.showAxis("top")
        self._plot.hideAxis("bottom")
        self._plot.invertY(True)
        self._lanes = _Lanes(tokens)
        self._plot.addItem(self._lanes)
        self._now = pg.InfiniteLine(angle=90)
        self._plot.addItem(self._now, ignoreBounds=True)
        column.addWidget(self._plot)
        self.setWidget(inner)
        self._following = True
        self._time = 0.0
        self.set_tokens(tokens)
        self.show_lanes((), 0.0)

    @property
    def lanes(self) -> tuple[Lane, ...]:
        """What is shown, for keyboards and tests."""
        return self._lanes.lanes

    def show_lanes(self, lanes: tuple[Lane, ...], time: float) -> None:
        """Show these lanes, with the present at ``time`` (simulated s)."""
        if [lane.label for lane in lanes] != [lane.label for lane in self._lanes.lanes]:
            left = self._plot.getAxis("left")
            left.setTicks([[(row + 0.5, lane.label) for row, lane in enumerate(lanes)]])
            self._plot.setMinimumHeight(AXIS + LANE * len(lanes) + 6)
        rows = max(len(lanes), (self.viewport().height() - AXIS) / LANE, 1)
        self._box.setYRange(0, rows, padding=0)
        self._time = time
        self._lanes.show_lanes(lanes, time)
        self._now.setPos(time)
        self._now.setVisible(bool(lanes))
        if self._following:
            self._box.setXRange(0, max(8.0, time * 1.12), padding=0)

    def follow(self) -> None:
        """Show everything, and go on doing so."""
        self._following = True
        self._box.setXRange(0, max(8.0, self._time * 1.12), padding=0)

    def set_tokens(self, tokens: Tokens) -> None:
        self._plot.setBackground(tokens.surf)
        self._now.setPen(pg.mkPen(tokens.acc, width=2))
        for name, font in (("top", text_font(12)), ("left", text_font(12))):
            axis = self._plot.getAxis(name)
            axis.setPen(pg.mkPen(tokens.line))
            axis.setTextPen(pg.mkPen(tokens.tx2))
            axis.setStyle(tickFont=font, tickLength=-4 if name == "top" else 0)
        self._plot.getAxis("left").setWidth(LABELS)
        self._plot.getAxis("top").setHeight(AXIS)
        self._lanes.tokens = tokens
        self._lanes.update()

    def _stop_following(self) -> None:
        self._following = False


class _TimeBox(pg.ViewBox):  # type: ignore[misc]  # pyqtgraph has no types
    """A view box that moves in time only, and says when a person moved it."""

    moved = pg.QtCore.Signal()
    reset = pg.QtCore.Signal()

    def __init__(self) -> None:
        super().__init__(enableMenu=False)
        self.setMouseEnabled(x=True, y=False)
        self.setLimits(xMin=0, minXRange=0.05)

    def wheelEvent(self, event: object, axis: int | None = None) -> None:
        self.moved.emit()
        super().wheelEvent(event, axis)

    def mouseDragEvent(self, event: object, axis: int | None = None) -> None:
        self.moved.emit()
        super().mouseDragEvent(event, axis)

    def mouseDoubleClickEvent(self, event: object) -> None:
        self.reset.emit()


class _Lanes(pg.GraphicsObject):  # type: ignore[misc]  # pyqtgraph has no types
    """Paints the spans of every lane in device pixels, so that text and corners stay sharp."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self.tokens = tokens
        self.lanes: tuple[Lane, ...] = ()
        self.time = 0.0

    def show_lanes(self, lanes: tuple[Lane, ...], time: float) -> None:
        self.prepareGeometryChange()
        self.lanes, self.time = lanes, time
        self.update()

    def boundingRect(self) -> QRectF:
        return QRectF(0, 0, max(self.time, 1.0) * 1.2 + 1, max(len(self.lanes), 1))

    def paint(self, painter: QPainter, *_: object) -> None:
        view = self.getViewBox()
        (left, right), _y = view.viewRange()
        transform = painter.transform()
        painter.save()
        painter.resetTransform()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        clip = transform.mapRect(self.mapRectFromScene(view.sceneBoundingRect()))
        for row, lane in enumerate(self.lanes):
            for index, span in enumerate(lane.spans):
                end = self.time if span.end is None else span.end
                if end < left or span.start > right:
                    continue
                box = transform.mapRect(QRectF(span.start, row, end - span.start, 1))
                last = index == len(lane.spans) - 1 and span.end is None
                painter.setClipRect(clip)
                colours = self._colours(lane.kind, span, last)
                _paint_span(painter, box.adjusted(0, 2, -1, -2), clip, lane.kind, span, colours)
        painter.restore()

    def _colours(self, kind: str, span: Span, last: bool) -> tuple[QColor, QColor, QColor]:
        t = self.tokens
        if kind == "state":
            return (t.acc, t.acc, t.onacc) if last else (t.accs, t.accl, t.acc)
        if kind == "operation":
            if last:
                return t.accs, t.acc, t.acc
            return (t.sunk, t.line2, t.tx) if span.good else (t.bads, t.bad, t.bad)
        if not span.good:
            return t.unks, t.unk, t.unk
        return (t.accs, t.accl, t.acc) if span.words == "h" else (t.sunk, t.sunk, t.tx2)


def _paint_span(  # noqa: PLR0917
    painter: QPainter,
    box: QRectF,
    clip: QRectF,
    kind: str,
    span: Span,
    colours: tuple[QColor, QColor, QColor],
) -> None:
    fill, line, ink = colours
    painter.setPen(QPen(line, 1))
    painter.setBrush(fill)
    painter.drawRoundedRect(box, 3, 3)
    words = span.words.rsplit("/", 1)[-1] if kind == "operation" else span.words
    font = mono_font(12, 400 if kind == "fact" else 600)
    painter.setFont(text_font(12, 600) if kind == "operation" else font)
    seen = box.intersected(clip)
    if QFontMetricsF(painter.font()).horizontalAdvance(words) + 6 <= seen.width():
        painter.setPen(ink)
        painter.drawText(seen, Qt.AlignmentFlag.AlignCenter, words)
