"""BothRuns: walks through a run on both sides of the compare view, up to a difference."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QTimer, Signal
from PySide6.QtWidgets import QHBoxLayout, QPushButton, QWidget

from smsl_studio.front.views.claim_run import RunStep
from smsl_studio.studio.base.controls import Elided, label
from smsl_studio.studio.base.icons import icon
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import counted

PACE = 800
"""How long each step is shown while the run plays (milliseconds)."""
Steps = tuple[RunStep, ...]


class BothRuns(QWidget):
    """A line with the present step, and buttons to go on and back. Without a run it is hidden.

    ``steps`` has the steps of both sides. One side may lack the last step: there the operation is
    not permitted.
    """

    step_shown = Signal(int)
    """int: the number of the step that both sides show. 0 is the start."""

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.steps: tuple[Steps, Steps] = (), ()
        self.at = 0
        self.words = Elided("")
        self.words.setProperty("role", "second")
        self.walk, self.back, self.step = QPushButton(), QPushButton("Back"), QPushButton("Step")
        self.walk.setToolTip("Walk through the run on both sides, one step after the other")
        self.back.setToolTip("One step back on both sides")
        self.step.setToolTip("One step on, on both sides")
        line = QHBoxLayout(self)
        line.setContentsMargins(14, 0, 14, 6)
        line.setSpacing(8)
        line.addWidget(label("Run after which they differ", "heading"))
        line.addWidget(self.words, 1)
        for button in (self.walk, self.back, self.step):
            button.setProperty("role", "row")
            button.setAutoDefault(False)
            line.addWidget(button)
        self.walk.clicked.connect(self._toggle)
        self.back.clicked.connect(lambda: self._by_hand(self.at - 1))
        self.step.clicked.connect(lambda: self._by_hand(self.at + 1))
        self._timer = QTimer(self)
        self._timer.setInterval(PACE)
        self._timer.timeout.connect(self._walk_on)
        self.set_tokens(tokens)
        self.hide()

    @property
    def last(self) -> int:
        """The number of the last step."""
        return max(len(one) for one in self.steps) - 1

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.back.setIcon(icon("step-back", tokens, 14))
        self.step.setIcon(icon("step", tokens, 14))
        self._dress()

    def show_runs(self, before: Sequence[RunStep], after: Sequence[RunStep]) -> None:
        """Show a run of each side, beginning at its start."""
        self.steps = tuple(before), tuple(after)
        self.show()
        self._go(0)

    def clear(self) -> None:
        """Show no run."""
        self._timer.stop()
        self.steps = (), ()
        self.hide()

    def _by_hand(self, at: int) -> None:
        self._stop()
        self._go(at)

    def _go(self, at: int) -> None:
        if not 0 <= at <= self.last:
            return
        self.at = at
        self.words.setText(self._said())
        self.back.setEnabled(at > 0)
        self.step.setEnabled(at < self.last)
        self.walk.setEnabled(self.last > 0)
        self.step_shown.emit(at)

    def _said(self) -> str:
        """Describe the step. If one side does not have it, say which."""
        where = f"{counted(self.last, 'operation')}, shown at "
        if not self.at:
            return f"{where}the start"
        sides = [one[self.at].operation if self.at < len(one) else None for one in self.steps]
        known = next((one for one in sides if one is not None), None)
        words = f"{where}step {self.at}, {known.operation if known else ''}"
        if None in sides:
            words += f": not permitted {'before' if sides[0] is None else 'after'} the change"
        return words

    def _toggle(self) -> None:
        if self._timer.isActive():
            self._stop()
            return
        if self.at == self.last:
            self._go(0)
        self._timer.start()
        self._dress()

    def _walk_on(self) -> None:
        self._go(self.at + 1)
        if self.at >= self.last:
            self._stop()

    def _stop(self) -> None:
        self._timer.stop()
        self._dress()

    def _dress(self) -> None:
        walking = self._timer.isActive()
        self.walk.setText("Pause" if walking else "Walk")
        self.walk.setIcon(icon("pause" if walking else "eye", self._tokens, 14))
