"""The timeline: states, operations and facts over simulated time, in lanes.

One item draws all lanes, so that a long run costs only what is visible. The wheel zooms in time at
the pointer, a drag pans, a double click shows everything and follows the run.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import pyqtgraph as pg
from PySide6.QtCore import QRectF, Qt, Signal
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QFrame, QHBoxLayout, QScrollArea, QWidget

from smsl_studio.front.views.timeline_lanes import Block, Lane
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Label
from smsl_studio.studio.base.focus_line import FocusLine
from smsl_studio.studio.base.theme import RADIUS_CHIP, Tokens, text_font
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.running.lane_blocks import seen_blocks, words_font, words_width

AXIS = 27
LABELS, WIDEST, EMPTY = 94, 190, 160
"""Width of the lane names: at least, at most, and without lanes (pixels)."""
EARLY = 0.0125
"""The part of the visible time that lies before the start, so that "0 s" has room."""
PITCH = {"state": 27, "operation": 27, "fact": 22}
NARROW = 2.0
"""A block narrower than this (pixels) has no round corners and no words."""
BESIDE = 4.0
"""Pixels between a block and words behind it."""
GAP = 8.0
"""How long ago a block may have ended that has words behind it (pixels)."""
SPANS = (0.5, 1.0, 2.0, 4.0, 8.0)
"""The visible simulated seconds of a young run; a longer run is shown whole."""


class Timeline(QScrollArea):
    """Lanes over time; ``show_lanes`` replaces them.

    The view follows the run until a person moves it.
    """

    time_wanted = Signal(float)
    """float: a click at this simulated time in seconds."""

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWidgetResizable(True)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setAccessibleName("Timeline")
        FocusLine(self)
        self.setToolTip("The wheel zooms in time, a drag pans, a double click shows all")
        self._inner = QWidget()
        self._inner.setProperty("role", "panel")
        self._lanes = _Lanes(tokens)
        self._labels = _Labels(tokens)
        self._box = _TimeBox()
        self._axis = _Seconds("top")
        self._plot = pg.PlotWidget(viewBox=self._box, axisItems={"top": self._axis})
        self._now = pg.InfiniteLine(angle=90)
        self._badge = Label("", self._plot)
        self._build()
        self._following = True
        self._time = 0.0
        self.set_tokens(tokens)
        self.show_lanes((), 0.0)

    @property
    def lanes(self) -> tuple[Lane, ...]:
        """The lanes that are shown, for tests."""
        return self._lanes.lanes

    @property
    def plot(self) -> pg.PlotWidget:
        """The plot that draws the lanes."""
        return self._plot

    def show_lanes(
        self,
        lanes: tuple[Lane, ...],
        time: float,
        present: frozenset[tuple[int, int]] = frozenset(),
    ) -> None:
        """Show these lanes; ``time`` is the present in simulated seconds.

        ``present`` are the past blocks that last at a moment of a recorded run (see
        ``present_blocks``).
        """
        if [lane.label for lane in lanes] != [lane.label for lane in self._lanes.lanes]:
            self._labels.show_lanes(lanes)
            self._inner.setMinimumHeight(AXIS + sum(PITCH[lane.kind] for lane in lanes) + 4)
        self._time = time
        self._lanes.show_lanes(lanes, time, present)
        self._now.setPos(time)
        self._now.setVisible(bool(lanes))
        self._axis.setVisible(bool(lanes))
        if self._following:
            self.follow()
        self._place_badge()

    def follow(self) -> None:
        """Show everything, and follow the run from now on."""
        self._following = True
        ends = [block.end or 0.0 for lane in self.lanes for block in lane.blocks[-1:]]
        needed = max(self._time * 1.05, *ends) if ends else SPANS[-1]
        beside = self._lanes.beside(needed, self._box.width())
        needed = max(needed, self._time / (1 - beside / max(self._box.width(), 1.0)))
        end = next((span for span in SPANS if span >= needed), needed)
        self._box.setXRange(-EARLY * end, end, padding=0)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._plot.setBackground(tokens.surf)
        self._now.setPen(pg.mkPen(tokens.acc, width=2))
        self._axis.setPen(pg.mkPen(tokens.line))
        self._axis.setTextPen(pg.mkPen(tokens.tx2))
        self._badge.setStyleSheet(
            f"background: {tokens.acc.name()}; color: {tokens.onacc.name()};"
            f" border-radius: {RADIUS_CHIP}px; padding: 1px 6px; font-weight: 600; font-size: 12px;"
        )
        self._lanes.tokens = self._labels.tokens = tokens
        self._lanes.update()
        self._labels.update()

    def _build(self) -> None:
        across = QHBoxLayout(self._inner)
        across.setContentsMargins(0, 0, 12, 0)
        across.setSpacing(0)
        across.addWidget(self._labels)
        across.addWidget(self._plot, 1)
        self.setWidget(self._inner)
        self._box.moved.connect(self._stop_following)
        self._box.reset.connect(self.follow)
        self._box.clicked.connect(self.time_wanted)
        self._box.sigXRangeChanged.connect(lambda *_: self._place_badge())
        self._box.sigResized.connect(lambda *_: self._fit_height())
        plot = self._plot
        plot.setFrameShape(QFrame.Shape.NoFrame)
        plot.hideButtons()
        plot.setMenuEnabled(False)
        plot.showAxis("top")
        plot.hideAxis("bottom")
        plot.hideAxis("left")
        plot.invertY(True)
        self._axis.setStyle(tickFont=text_font(12), tickLength=0, maxTickLevel=0, tickTextOffset=6)
        self._axis.setZValue(-1000)
        self._axis.setHeight(AXIS)
        self._axis.setGrid(90)
        plot.addItem(self._lanes)
        plot.addItem(self._now, ignoreBounds=True)

    def _fit_height(self) -> None:
        """Make one vertical unit one pixel, so that lanes have the heights of the design."""
        self._box.setYRange(0, max(self._box.height(), 1.0), padding=0)
        self._place_badge()

    def _place_badge(self) -> None:
        self._badge.setVisible(bool(self.lanes))
        (left, right), _ = self._box.viewRange()
        self._badge.setText(f"{self._time:.{1 if right - left > 1 else 2}f} s")
        self._badge.adjustSize()
        room = 0.9 * self._badge.width() * (right - left) / max(self._box.width(), 1.0)
        self._axis.hide_from_to(self._time - room, self._time + room)
        share = (self._time - left) / max(right - left, 1e-9)
        at = round(share * self._box.width()) - self._badge.width() // 2
        at = min(max(at, 0), max(self._plot.width() - self._badge.width(), 0))
        self._badge.move(at, (AXIS - self._badge.height()) // 2)

    def _stop_following(self) -> None:
        self._following = False


class _Labels(QWidget):
    """The names of the lanes at the left."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self.tokens = tokens
        self._lanes: Sequence[Lane] = ()
        self.setFixedWidth(EMPTY)

    def show_lanes(self, lanes: Sequence[Lane]) -> None:
        """Show the names of these lanes; the width fits the longest."""
        self._lanes = lanes
        metrics = QFontMetricsF(text_font(12))
        needed = max((metrics.horizontalAdvance(lane.label) for lane in lanes), default=0.0) + 22
        self.setFixedWidth(int(min(max(needed, LABELS), WIDEST)) if lanes else EMPTY)
        self.setAccessibleName(plain_text(", ".join(lane.label for lane in lanes)))
        self.setToolTip(tip_text("\n".join(lane.label for lane in lanes)))
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the name of each lane."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), self.tokens.surf)
        middle = Qt.AlignmentFlag.AlignVCenter
        painter.setFont(text_font(13, 600))
        painter.setPen(self.tokens.tx)
        painter.drawText(QRectF(12, 0, LABELS - 12, AXIS), middle, "Timeline")
        painter.setFont(text_font(12))
        painter.setPen(self.tokens.tx2)
        if not self._lanes:
            painter.drawText(QRectF(12, AXIS, EMPTY - 12, 27), middle, "Starts with the run")
        top = float(AXIS)
        for lane in self._lanes:
            room = QRectF(12, top, self.width() - 20, PITCH[lane.kind])
            shown = painter.fontMetrics().elidedText(
                plain_text(lane.label), Qt.TextElideMode.ElideMiddle, int(room.width())
            )
            painter.drawText(room, middle, shown)
            top += PITCH[lane.kind]
        painter.end()


class _Seconds(pg.AxisItem):  # type: ignore[misc]  # pyqtgraph has no types
    """A time axis whose tick labels have their unit."""

    def __init__(self, orientation: str) -> None:
        super().__init__(orientation)
        self._hidden = (0.0, 0.0)

    def hide_from_to(self, low: float, high: float) -> None:
        """Leave out the labels between two times, where the badge of the present covers them."""
        if (low, high) != self._hidden:
            self._hidden = (low, high)
            self.picture = None
            self.update()

    def tickStrings(self, values: list[float], scale: float, spacing: float) -> list[str]:
        """The labels of the ticks in seconds; empty where the badge of the present covers them."""
        digits = 0 if spacing >= 1 else 1 if spacing >= 0.1 else 2
        low, high = self._hidden
        return ["" if low < v < high else f"{v:.{digits}f} s" for v in values]


class _TimeBox(pg.ViewBox):  # type: ignore[misc]  # pyqtgraph has no types
    """A view box that moves only in time, and emits a signal when a person moved it."""

    moved = pg.QtCore.Signal()
    reset = pg.QtCore.Signal()
    clicked = pg.QtCore.Signal(float)

    def __init__(self) -> None:
        super().__init__(enableMenu=False, defaultPadding=0)
        self.setMouseEnabled(x=True, y=False)
        self.setLimits(minXRange=0.05)

    def wheelEvent(self, event: object, axis: int | None = None) -> None:
        """Zoom in time at the pointer."""
        self.moved.emit()
        super().wheelEvent(event, axis)

    def mouseDragEvent(self, event: object, axis: int | None = None) -> None:
        """Pan in time."""
        self.moved.emit()
        super().mouseDragEvent(event, axis)

    def mouseDoubleClickEvent(self, event: object) -> None:
        """Ask to show everything again."""
        self.reset.emit()

    def mouseClickEvent(self, event: Any) -> None:
        """Emit the clicked time in simulated seconds."""
        if event.button() == Qt.MouseButton.LeftButton:
            self.clicked.emit(self.mapSceneToView(event.scenePos()).x())
            event.accept()


class _Lanes(pg.GraphicsObject):  # type: ignore[misc]  # pyqtgraph has no types
    """Paints the blocks of all lanes in pixels, so that texts and corners stay sharp."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self.tokens = tokens
        self.lanes: tuple[Lane, ...] = ()
        self._starts: list[list[float]] = []
        self.time = 0.0
        self.present: frozenset[tuple[int, int]] = frozenset()

    def show_lanes(
        self, lanes: tuple[Lane, ...], time: float, present: frozenset[tuple[int, int]]
    ) -> None:
        """Show other lanes; ``time`` is the present in simulated seconds."""
        self.prepareGeometryChange()
        if lanes is not self.lanes:
            self._starts = [[block.start for block in lane.blocks] for lane in lanes]
        self.lanes, self.time, self.present = lanes, time, present
        self.update()

    def boundingRect(self) -> QRectF:
        """The area: simulated seconds across, pixels down."""
        high = float(sum(PITCH[lane.kind] for lane in self.lanes))
        ends = [block.end or 0.0 for lane in self.lanes for block in lane.blocks[-1:]]
        return QRectF(0, 0, max(self.time, *ends, 1.0) if ends else 1.0, max(high, 1.0))

    def paint(self, painter: QPainter, *_: object) -> None:
        """Paint the visible blocks."""
        view = self.getViewBox()
        (left, right), _y = view.viewRange()
        transform = painter.transform()
        painter.save()
        painter.resetTransform()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        clip = transform.mapRect(self.mapRectFromScene(view.sceneBoundingRect()))
        painter.setClipRect(clip)
        top = 0.0
        pixel = NARROW / max(transform.m11(), 1e-12)
        for row, (lane, starts) in enumerate(zip(self.lanes, self._starts, strict=True)):
            narrow = self._colours(lane.kind, "past")[0]
            last = len(lane.blocks) - 1
            pitch = float(PITCH[lane.kind])
            for at in seen_blocks(lane.blocks, starts, left, right, pixel):
                block = lane.blocks[at]
                end = self.time if block.end is None else block.end
                room = transform.mapRect(QRectF(block.start, top, end - block.start, pitch))
                gap = (self.time - end) * transform.m11()
                if at == last and gap < GAP and room.width() < words_width(lane.kind, block.words):
                    self._say_beside(painter, room, lane.kind, block)
                if room.width() < NARROW:
                    painter.fillRect(room.adjusted(0, 2, NARROW, -2), narrow)
                    continue
                past = block.look == "past" and lane.kind != "fact"
                look = "now" if past and (row, at) in self.present else block.look
                self._paint(painter, room, clip, lane.kind, block, look)
            top += pitch
        painter.restore()

    def beside(self, until: float, width: float) -> float:
        """The pixels that words need behind the last blocks, a third of ``width`` at most.

        ``until`` simulated seconds are shown in ``width`` pixels.
        """
        needed = 0.0
        for lane in self.lanes:
            for block in lane.blocks[-1:]:
                wide = words_width(lane.kind, block.words)
                end = self.time if block.end is None else block.end
                each = width / max(until, 1e-9)
                if (end - block.start) * each < wide and (self.time - end) * each < GAP:
                    needed = max(needed, wide + BESIDE)
        return min(needed, width / 3)

    def _say_beside(self, painter: QPainter, room: QRectF, kind: str, block: Block) -> None:
        """Paint the last words of a lane behind their block if the block is too short for them.

        So the goal of a long run can be read. A block that ended before has no words behind it:
        they would stand where something else was, or nothing.
        """
        if block.look == "predicted":
            return
        painter.setFont(words_font(kind))
        painter.setPen(self.tokens.tx)
        left = max(room.right(), room.left() + NARROW) + BESIDE
        words = QRectF(left, room.top(), words_width(kind, block.words), room.height())
        painter.drawText(words, Qt.AlignmentFlag.AlignVCenter, plain_text(block.words))

    def _paint(
        self, painter: QPainter, room: QRectF, clip: QRectF, kind: str, block: Block, look: str
    ) -> None:
        inset = 2.0 if kind == "fact" else 1.5
        box = room.adjusted(0.5, inset, -0.5, -inset)
        fill, line, ink = self._colours(kind, look)
        dashed = look in ("predicted", "unknown")
        style = Qt.PenStyle.DashLine if dashed else Qt.PenStyle.SolidLine
        painter.setPen(QPen(line, 1.2, style) if line is not None else Qt.PenStyle.NoPen)
        painter.setBrush(fill)
        painter.drawRoundedRect(box, 3 if line is not None else 0, 3 if line is not None else 0)
        painter.setFont(words_font(kind))
        seen = box.intersected(clip)
        if words_width(kind, block.words) <= seen.width():
            painter.setPen(ink)
            painter.drawText(seen, Qt.AlignmentFlag.AlignCenter, plain_text(block.words))

    def _colours(self, kind: str, look: str) -> tuple[QColor, QColor | None, QColor]:
        t = self.tokens
        if look == "predicted":
            return t.surf, t.accl, t.acc
        if look in ("bad", "unknown"):
            return (t.bads, t.bad, t.bad) if look == "bad" else (t.unks, t.unk, t.unk)
        if kind == "state":
            return (t.acc, t.acc, t.onacc) if look == "now" else (t.accs, t.accl, t.acc)
        if kind == "operation":
            return (t.accs, t.acc, t.acc) if look == "now" else (t.sunk, t.line2, t.tx)
        return (t.accs, t.accl, t.acc) if look == "beyond" else (t.sunk, None, t.tx)
