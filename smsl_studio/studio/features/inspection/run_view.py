"""The run that shows why something fails: its steps as cards, and buttons that walk through it."""

from __future__ import annotations

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QIcon, QResizeEvent
from PySide6.QtWidgets import QFrame, QPushButton, QScrollArea, QVBoxLayout, QWidget

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.claim_rows import ClaimRow
from smsl_studio.front.views.claim_run import RunStep, script_of, steps_of
from smsl_studio.inspection.proof.verdict import Counterexample
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Elided, label, row
from smsl_studio.studio.base.icons import icon
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.features.inspection.lit_run import LitRun
from smsl_studio.studio.features.inspection.run_cards import RunCards
from smsl_studio.studio.features.inspection.run_strip import BranchNames, RunStrip

NARROW = 560
"""In a page narrower than this the buttons show icons only (pixels)."""
PACE = 800
"""Milliseconds that a step is shown while the run is walked."""
BAD_END = ("hazard", "never", "before", "after", "way_back")
"""The kinds whose runs end where something is wrong."""


class RunView(QWidget):
    """One run. ``lit`` shows its step on the drawing."""

    play_wanted = Signal(str)
    """The text of a script: run it."""
    save_wanted = Signal(str)
    """The text of a script: save it."""

    def __init__(self, lit: LitRun, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.lit, self._tokens = lit, tokens
        self._blueprint: Blueprint | None = None
        self._narrow = False
        self._begins_at_start = True
        self.title = label("", "heading")
        self.count = Elided("")
        self.count.setProperty("role", "second")
        self.walk, self.back, self.step = QPushButton(), QPushButton("Back"), QPushButton("Step")
        self.walk.setProperty("role", "row")
        self.walk.setToolTip("Walk through the run on the drawing, one step after the other")
        self.back.setProperty("role", "row")
        self.back.setToolTip("One step back")
        self.step.setProperty("role", "row")
        self.step.setToolTip("One step on")
        self.walk.clicked.connect(self._toggle_walk)
        self.back.clicked.connect(lambda: self._go(self.lit.at - 1))
        self.step.clicked.connect(lambda: self._go(self.lit.at + 1))
        self.play, self.save = QPushButton("Play it"), QPushButton("Save script…")
        self.play.setProperty("role", "primary")
        self.play.setToolTip("Run these operations by hand, in the world that is chosen in Run")
        self.save.setProperty("role", "row")
        self.save.setToolTip("Save them as a script for “smsl-studio run --script”")
        self.play.clicked.connect(lambda: self.play_wanted.emit(self._script()))
        self.save.clicked.connect(lambda: self.save_wanted.emit(self._script()))
        self.buttons = row(self.walk, self.back, self.step, self.save, self.play, spacing=6)
        self.strip = RunStrip(tokens)
        self.strip.step_wanted.connect(self._go)
        self.area = QScrollArea()
        self.area.setFrameShape(QFrame.Shape.NoFrame)
        self.area.setWidget(self.strip)
        self.area.setAccessibleName("Steps of the run")
        self.area.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.names = BranchNames(tokens)
        self.area.verticalScrollBar().valueChanged.connect(lambda _: self._name_rows())
        self._timer = QTimer(self)
        self._timer.setInterval(PACE)
        self._timer.timeout.connect(self._walk_on)
        head = row(self.title, self.count, spacing=8)
        head.addLayout(self.buttons)
        head.setContentsMargins(12, 6, 12, 6)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addLayout(head)
        column.addLayout(row(self.names, self.area, spacing=0), 1)
        lit.moved.connect(self._moved)
        self._dress()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.strip.set_tokens(tokens)
        self.names.set_tokens(tokens)
        self._dress()

    def show_run(self, blueprint: Blueprint, claim: ClaimRow) -> None:
        """Show the run of a row, at its start."""
        assert claim.run is not None
        bad = claim.kind in BAD_END
        self._begins_at_start = True
        self.title.setText("Shortest run to it" if bad else "The cheapest route")
        steps = steps_of(blueprint, claim.run)
        self._show(blueprint, RunCards(blueprint, steps, claim.met), steps, bad)

    def show_way(self, blueprint: Blueprint, run: Counterexample) -> None:
        """Show the way back from a failure. It does not begin where a run begins, so it is not
        played in a world."""
        self._begins_at_start = False
        self.title.setText("Shortest way back")
        steps = steps_of(blueprint, run)
        self._show(blueprint, RunCards(blueprint, steps, frozenset()), steps, False)

    def show_steps(
        self, blueprint: Blueprint, steps: tuple[RunStep, ...], title: str, bad: bool = False
    ) -> None:
        """Show a run from the start. ``bad`` marks its end as a fault."""
        self._begins_at_start = True
        self.title.setText(title)
        self._show(blueprint, RunCards(blueprint, steps), steps, bad)

    def _show(
        self, blueprint: Blueprint, cards: RunCards, steps: tuple[RunStep, ...], bad: bool
    ) -> None:
        self._stop()
        self._blueprint = blueprint
        self.strip.show_run(cards, bad)
        self._name_rows()
        for button in (self.play, self.save):
            button.setVisible(self._begins_at_start)
        self.lit.show_steps(steps, bad=bad)
        self._moved(0)

    def clear(self) -> None:
        """Show no run, here and on the drawing."""
        self._stop()
        self.strip.show_run(None)
        if self.lit.steps:
            self.lit.show_steps(())

    def _script(self) -> str:
        assert self._blueprint is not None
        return script_of(self._blueprint, self.lit.steps)

    def _name_rows(self) -> None:
        cards = self.strip.cards
        shown = cards.branches if cards is not None else ()
        self.names.show_names(shown, self.area.verticalScrollBar().value())

    def _go(self, at: int) -> None:
        self._stop()
        self.lit.go(at)

    def _moved(self, at: int) -> None:
        self.strip.show_step(at)
        last = self.lit.last
        where = f", shown at step {at}" if at else ", shown at the start"
        hidden = self.strip.cards.hidden if self.strip.cards else 0
        left_out = f"; {counted(hidden, 'State Branch', 'State Branches')} not shown"
        self.count.setText(f"{counted(last, 'operation')}{where}{left_out if hidden else ''}")
        self.back.setEnabled(at > 0)
        self.step.setEnabled(at < last)
        for button in (self.walk, self.play, self.save):
            button.setEnabled(last > 0)

    def _toggle_walk(self) -> None:
        if self._timer.isActive():
            self._stop()
            return
        if self.lit.at == self.lit.last:
            self.lit.go(0)
        self._timer.start()
        self._dress()

    def _walk_on(self) -> None:
        if self.lit.at < self.lit.last and self.isVisible():
            self.lit.go(self.lit.at + 1)
        if self.lit.at >= self.lit.last or not self.isVisible():
            self._stop()

    def _stop(self) -> None:
        if self._timer.isActive():
            self._timer.stop()
            self._dress()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Show icons only on the buttons of a narrow page, so that the title has space."""
        super().resizeEvent(event)
        narrow = self.width() < NARROW
        if narrow != self._narrow:
            self._narrow = narrow
            self.title.setVisible(not narrow)
            self._dress()

    def _dress(self) -> None:
        walking = self._timer.isActive()
        faces = (
            (self.walk, "Pause" if walking else "Walk", "pause" if walking else "eye"),
            (self.back, "Back", "step-back"),
            (self.step, "Step", "step"),
            (self.save, "Save script…", "save" if self._narrow else ""),
            (self.play, "Play it", "play" if self._narrow else ""),
        )
        for button, words, picture in faces:
            button.setText("" if self._narrow else words)
            button.setAccessibleName(plain_text(words))
            on = self._tokens.onacc if button is self.play else None
            button.setIcon(icon(picture, self._tokens, 14, on) if picture else QIcon())
