"""The plot of what the sources of a fact have measured, with the thresholds of its predicates."""

from __future__ import annotations

from math import isnan

import pyqtgraph as pg
from PySide6.QtCore import Qt
from PySide6.QtGui import QBrush, QColor
from PySide6.QtWidgets import QFrame, QHBoxLayout, QVBoxLayout, QWidget

from smsl_studio.blueprint.check import FactKey
from smsl_studio.front.views.measure_traces import AXES, SPAN, MeasuredFact, MeasureTrace
from smsl_studio.legible import markup, plain_text
from smsl_studio.studio.base.controls import Combo, Elided, Label, label
from smsl_studio.studio.base.theme import Tokens, text_font
from smsl_studio.studio.running.fact_strip import FactStrip

HEIGHT, LOW = 250, 232
"""The height in a wide page, and beside a plan, where the notation is left out."""
AXIS = 44
"""The room for the numbers at the left of a plot."""
MARGIN = 0.24
"""The part of the shown range that stays free above and below."""
CLOSE = 0.15
"""Bounds that are closer than this part of the range of all bounds would cross words."""


class MeasurePlot(QWidget):
    """A plot of one source at a time, and the fact in the notation of the paper below it.

    It is hidden while there is nothing to plot.
    """

    def __init__(self, tokens: Tokens, low: bool = False) -> None:
        super().__init__()
        self._tokens, self._low = tokens, low
        self._traces: tuple[MeasureTrace, ...] = ()
        self._fact: FactKey | None = None
        self._now = 0.0
        self.source = Combo()
        self.source.setAccessibleName("Source that is plotted")
        self.source.setMinimumWidth(140)
        self.source.currentIndexChanged.connect(lambda _: self._draw())
        self.newest = Elided()
        self._legend = Label(rich=True)
        self.notation = Label()
        self.notation.setProperty("role", "mono")
        self.notation.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.notation.setContentsMargins(12, 4, 12, 6)
        self.plot = pg.PlotWidget()
        self.plot.setAccessibleName("Measures of the last 30 s")
        self.plot.setToolTip("Seconds before now")
        self.plot.setFrameShape(QFrame.Shape.NoFrame)
        self.plot.setMinimumHeight(120)
        self.plot.hideButtons()
        self.plot.setMenuEnabled(False)
        self.plot.setMouseEnabled(x=False, y=False)
        self.plot.getAxis("left").setWidth(AXIS)
        self._gaps: list[pg.LinearRegionItem] = []
        self._between: list[pg.LinearRegionItem] = []
        self.strip = FactStrip(tokens, AXIS)
        self._curves: list[pg.PlotDataItem] = []
        self._lines: list[pg.InfiniteLine] = []
        across = QHBoxLayout()
        across.setContentsMargins(12, 6, 12, 4)
        across.setSpacing(8)
        for part in (label("30 s of" if low else "Last 30 s of", "second"), self.source,
                     self._legend):  # fmt: skip
            across.addWidget(part)
        across.addWidget(self.newest, 1)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addLayout(across)
        column.addWidget(self.plot, 1)
        below = QHBoxLayout()
        below.setContentsMargins(0, 0, 0, 4)
        below.addWidget(self.strip)
        column.addLayout(below)
        column.addWidget(self.notation)
        self.notation.setVisible(not low)
        self.setFixedHeight(LOW if low else HEIGHT)
        self.set_tokens(tokens)
        self.hide()

    def show_measured(self, measured: MeasuredFact | None) -> None:
        """Show the sources of a fact; None hides the plot."""
        fact = measured.key if measured is not None else None
        traces = self._traces = measured.traces if measured is not None else ()
        notation = measured.notation if measured is not None else ()
        self._now = measured.now if measured is not None else 0.0
        self.strip.show_values(measured.values if measured is not None else (), self._now)
        if fact != self._fact or self.source.count() != len(traces):
            self._fact = fact
            self.source.blockSignals(True)
            self.source.clear()
            for trace in traces:
                self.source.addItem(plain_text(trace.source))
            self.source.blockSignals(False)
        self.notation.setText("\n".join(map(plain_text, notation)))
        if not self._low:
            self.setFixedHeight(HEIGHT + max(0, len(notation) - 3) * 16)
        self.setVisible(bool(traces))
        self._draw()

    def choose(self, source: str) -> None:
        """Plot this source, if the fact has it."""
        names = [one.source for one in self._traces]
        if source in names:
            self.source.setCurrentIndex(names.index(source))

    @property
    def fact(self) -> FactKey | None:
        """The fact whose sources are plotted."""
        return self._fact

    @property
    def shown(self) -> MeasureTrace | None:
        """The source that is plotted."""
        at = self.source.currentIndex()
        return self._traces[at] if 0 <= at < len(self._traces) else None

    @property
    def thresholds(self) -> tuple[float, ...]:
        """The heights of the lines that are drawn."""
        return tuple(float(line.value()) for line in self._lines)

    @property
    def gaps(self) -> tuple[tuple[float, float], ...]:
        """From and to (s, negative: ago) of each time at which nothing was measured."""
        return tuple((float(low), float(high)) for low, high in (r.getRegion() for r in self._gaps))

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.strip.set_tokens(tokens)
        self.plot.setBackground(tokens.surf)
        for side in ("left", "bottom"):
            axis = self.plot.getAxis(side)
            axis.setPen(pg.mkPen(tokens.line2))
            axis.setTextPen(pg.mkPen(tokens.tx2))
            axis.setTickFont(text_font(11))
        self._remake()

    def _remake(self) -> None:
        """Draw anew all that has colours."""
        for item in (*self._curves, *self._lines, *self._gaps, *self._between):
            self.plot.removeItem(item)
        self._curves, self._lines, self._gaps, self._between = [], [], [], []
        self._draw()

    def _draw(self) -> None:
        trace = self.shown
        if trace is None:
            return
        inks = (self._tokens.acc, self._tokens.ok, self._tokens.risk)
        while len(self._curves) < len(trace.lines):
            pen = pg.mkPen(inks[len(self._curves)], width=1.6)
            self._curves.append(self.plot.plot([], [], pen=pen, connect="finite"))
        for curve in self._curves[len(trace.lines) :]:
            curve.setData([], [])
        ago = [time - self._now for time in trace.times]
        for curve, line in zip(self._curves, trace.lines, strict=False):
            # A measure stays as it is until the next one, and until now.
            curve.setData([*ago, 0.0] if ago else [], [*line, *line[-1:]])
        self._place_gaps(trace, ago)
        self._place_lines(trace)
        self._fit(trace)
        unit = "" if trace.unit == "1" else trace.unit
        self.plot.setLabel("left", unit, color=self._tokens.tx2.name())
        now = trace.newest if trace.missing else f"now {trace.newest}"
        self.newest.setText(now if trace.times else "nothing measured yet")
        many = len(trace.lines) if len(trace.lines) > 1 else 0
        named = zip(AXES[:many], inks, strict=False)
        words = (f'<span style="color:{ink.name()}">{markup(axis)}</span>' for axis, ink in named)
        self._legend.setText(" ".join(words))
        said = "; ".join(one.words for one in trace.thresholds)
        self.plot.setAccessibleDescription(
            plain_text(f"{trace.source}: {self.newest.text()}; thresholds: {said or 'none'}")
        )

    def _place_gaps(self, trace: MeasureTrace, ago: list[float]) -> None:
        """Hatch the times at which nothing was measured."""
        gaps: list[tuple[float, float]] = []
        ends = [*ago[1:], 0.0][: len(ago)]
        for begin, end, value in zip(ago, ends, trace.lines[0], strict=True):
            if not isnan(value):
                continue
            joined = gaps.pop()[0] if gaps and gaps[-1][1] == begin else begin
            gaps.append((joined, end))
        while len(self._gaps) > len(gaps):
            self.plot.removeItem(self._gaps.pop())
        while len(self._gaps) < len(gaps):
            self._gaps.append(self._region("vertical", self._hatch()))
        for region, gap in zip(self._gaps, gaps, strict=True):
            region.setRegion(gap)

    def _hatch(self) -> QBrush:
        return QBrush(self._tokens.unk, Qt.BrushStyle.BDiagPattern)

    def _region(self, way: str, brush: QBrush) -> pg.LinearRegionItem:
        region = pg.LinearRegionItem(
            orientation=way, brush=brush, pen=pg.mkPen(None), movable=False
        )
        region.setZValue(-10)
        self.plot.addItem(region)
        return region

    def _place_lines(self, trace: MeasureTrace) -> None:
        """Draw the thresholds. They stay the same for a source, so mostly nothing is to do."""
        wanted = [(one.at, plain_text(one.words)) for one in trace.thresholds]
        if [(line.value(), line.label.format) for line in self._lines] == wanted:
            return
        for item in (*self._lines, *self._between):
            self.plot.removeItem(item)
        self._between = []
        bounds = sorted({at for at, _ in wanted})
        if len(bounds) == 2:
            # Between the two bounds the last value stays.
            self._between = [self._region("horizontal", QBrush(self._tokens.sunk))]
            self._between[0].setRegion(bounds)
        tokens = self._tokens
        ink = QColor(tokens.tx2)
        pen = pg.mkPen(ink, width=1.2, style=Qt.PenStyle.DashLine)
        self._lines = []
        for number, (at, words) in enumerate(wanted):
            # The words of a bound stand below it if the next higher one would cross them.
            crossed = any(at < other < at + CLOSE * (bounds[-1] - bounds[0]) for other in bounds)
            anchor = [(0.0, 0.0), (0.0, 0.0)] if crossed else [(0.0, 1.0), (0.0, 1.0)]
            options = {"position": 0.02 + 0.33 * (number % 3), "color": ink, "anchors": anchor}
            line = pg.InfiniteLine(at, angle=0, pen=pen, label=words, labelOpts=options)
            self._lines.append(line)
            self.plot.addItem(line)

    def _fit(self, trace: MeasureTrace) -> None:
        """Show all of the last 30 s, and every threshold."""
        values = [value for line in trace.lines for value in line if not isnan(value)]
        values += [one.at for one in trace.thresholds]
        low, high = (min(values), max(values)) if values else (0.0, 1.0)
        if high - low < 0.2 * abs(high):
            # So small a part of a number would look like a large change.
            low, high = min(low, 0.0), max(high, 0.0)
        room = MARGIN * (high - low) or abs(high) * MARGIN or 1.0
        self.plot.setXRange(-SPAN, 0.0, padding=0)
        self.plot.setYRange(low - room, high + room, padding=0)
