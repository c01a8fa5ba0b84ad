"""The forecasts of a run against what came, in the monitor: a table, and a plot of the share."""

from __future__ import annotations

from functools import partial

import pyqtgraph as pg
from PySide6.QtWidgets import QFrame, QPushButton, QVBoxLayout, QWidget

from smsl_studio.front.forecast_drift import ForecastRecord, drift_of, recorded_drift
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.beside import Beside
from smsl_studio.studio.base.controls import Elided, row
from smsl_studio.studio.base.rows import ListRow, RowsView
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.running.frames import head
from smsl_studio.studio.running.run_session import RunSession

HIGH = 96
"""The height of the plot (pixels)."""
OTHERS = "Recorded runs", "This run"


class DriftPanel(QWidget):
    """Hidden while no forecast was compared. The button shows the recorded runs, or the present
    one again."""

    def __init__(self, run: RunSession, tokens: Tokens) -> None:
        super().__init__()
        self._run, self._tokens = run, tokens
        self._recorded: ForecastRecord | None = None
        self._beside = Beside(self)
        self.words = Elided()
        self.other = QPushButton(OTHERS[0])
        self.other.setToolTip(tip_text("The newest 200 recordings, or the present run again"))
        self.other.clicked.connect(lambda: self._turn())
        self.rows = RowsView(tokens)
        self.rows.setAccessibleName("Forecasts by operation")
        self.plot = pg.PlotWidget()
        self.plot.setAccessibleName("Share of the forecasts that were right")
        self.plot.setFrameShape(QFrame.Shape.NoFrame)
        self.plot.setFixedHeight(HIGH)
        self.plot.hideButtons()
        self.plot.setMenuEnabled(False)
        self.plot.setMouseEnabled(x=False, y=False)
        self.plot.setYRange(0, 1)
        self._curve = self.plot.plot([], [])
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(head("Forecasts", None, self.other))
        across = row(self.words)
        across.setContentsMargins(12, 0, 12, 4)
        column.addLayout(across)
        column.addWidget(self.rows, 1)
        column.addWidget(self.plot)
        self.hide()

    @property
    def drift(self) -> ForecastRecord:
        """What is shown."""
        return self._recorded or drift_of(self._run.forecaster.compared)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.rows.set_tokens(tokens)
        self.plot.setBackground(tokens.surf)
        self._curve.setPen(pg.mkPen(tokens.acc, width=2))

    def refresh(self) -> None:
        """Show the comparisons so far."""
        drift = self.drift
        self.setVisible(bool(drift.outcomes) or self._recorded is not None)
        self.other.setText(OTHERS[self._recorded is not None])
        self.words.setText(plain_text(drift.words or "No recorded run has forecasts"))
        self.rows.show_rows([
            ListRow(one.operation, icon="check" if one.right == one.count else "close",
                    right=f"{one.right} of {one.count}", tip=one.reason or one.operation)
            for one in drift.rows
        ])  # fmt: skip
        shares = drift.shares
        self._curve.setData([*range(1, len(shares) + 1)], [*shares])

    def _turn(self) -> None:
        folder = self._run.recordings
        if self._recorded is not None or folder is None:
            self._recorded = None
            self.refresh()
        else:
            self.words.setText("Reading the recordings")
            self._beside.do(partial(recorded_drift, folder), self._take)

    def _take(self, found: ForecastRecord) -> None:
        self._recorded = found
        self.refresh()
