"""The plot of what a recorded run measured, below its state check, at the moment that is shown."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QVBoxLayout, QWidget

from smsl_studio.blueprint.check import FactKey
from smsl_studio.front.views.measure_traces import measured_of
from smsl_studio.studio.base.controls import label, row, rule
from smsl_studio.studio.base.small_button import SmallButton
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.replay.replay import Replay

if TYPE_CHECKING:
    from smsl_studio.studio.running.measure_plot import MeasurePlot

NOTHING = "Nothing was measured for it: no predicates decide this fact."


class RecordedPlot(QWidget):
    """Hidden until a fact is chosen. The plot is made then, because its library takes time."""

    changed = Signal()
    """Another fact is plotted, or none."""

    def __init__(self, replay: Replay, tokens: Tokens) -> None:
        super().__init__()
        self._replay, self._tokens = replay, tokens
        self.fact: FactKey | None = None
        self.plot: MeasurePlot | None = None
        self.name, self.nothing = label("", "heading"), label(NOTHING, "hint")
        self.nothing.setContentsMargins(12, 0, 12, 8)
        self.nothing.setWordWrap(True)
        self.close_button = SmallButton("Leave the plot", "close", tokens)
        self.close_button.clicked.connect(lambda: self.choose(None))
        top = row(self.name, None, self.close_button)
        top.setContentsMargins(12, 4, 8, 0)
        self._column = QVBoxLayout(self)
        self._column.setContentsMargins(0, 0, 0, 0)
        self._column.setSpacing(0)
        self._column.addWidget(rule())
        self._column.addLayout(top)
        self._column.addWidget(self.nothing)
        self.hide()

    def choose(self, fact: FactKey | None) -> None:
        """Plot the sources of a fact; None hides the plot."""
        self.fact = fact
        self.setVisible(fact is not None)
        self.refresh()
        self.changed.emit()

    def refresh(self) -> None:
        """Show the last 30 s before the moment that is shown."""
        replay, fact = self._replay, self.fact
        if fact is None or replay.blueprint is None or fact[0] not in replay.blueprint.branches:
            self.hide()
            return
        self.name.setText(replay.blueprint[fact[0]].fact_name(fact[1]))
        measured = measured_of(replay.blueprint, fact, replay.story.history, replay.time)
        self.nothing.setVisible(measured is None)
        if self.plot is None and measured is not None:
            from smsl_studio.studio.running.measure_plot import MeasurePlot

            self.plot = MeasurePlot(self._tokens, low=True)
            self._column.addWidget(self.plot)
        if self.plot is not None:
            self.plot.show_measured(measured)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.close_button.set_tokens(tokens)
        if self.plot is not None:
            self.plot.set_tokens(tokens)
