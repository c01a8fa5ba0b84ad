"""The transport: what to run, how fast, and the buttons that play, step, pause and stop it."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QIntValidator
from PySide6.QtWidgets import QHBoxLayout, QLabel, QToolButton, QWidget

from smsl_studio.studio.controls import Combo, Field, label, rule
from smsl_studio.studio.key_button import KeyButton
from smsl_studio.studio.run.runner import FASTEST
from smsl_studio.studio.theme import Tokens

SPEEDS = {"¼×": 0.25, "½×": 0.5, "1×": 1.0, "2×": 2.0, "4×": 4.0, "8×": 8.0, "Max": FASTEST}
LONGEST = 150
PHASES = {
    "": ("Ready", "quiet"),
    "opening": ("Opening", "quiet"),
    "ready": ("Waiting", "quiet"),
    "running": ("Running", "busy"),
    "paused": ("Paused", "quiet"),
    "held": ("Held", "held"),
    "goal_reached": ("Goal reached", "good"),
    "stopped": ("Stopped", "quiet"),
    "failed": ("Fault hold", "held"),
    "refused": ("Refused", "held"),
    "no_route": ("No route", "held"),
}


class Transport(QWidget):
    """A row for the mode bar. It knows no run: it offers choices and says what was pressed."""

    play_wanted = Signal()
    pause_wanted = Signal()
    step_wanted = Signal()
    stop_wanted = Signal()
    speed_changed = Signal(float)
    by_hand_changed = Signal(bool)

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._running = False
        across = QHBoxLayout(self)
        across.setContentsMargins(0, 0, 0, 0)
        across.setSpacing(8)
        self.world = self._choice(across, "World", 92, "Where the blueprint is run")
        self.start = self._choice(across, "Start", 68, "The state the run starts in")
        self.goal = self._choice(across, "Goal", 68, "The state the run ends in")
        across.addWidget(label("Seed", "small"))
        self.seed = Field()
        self.seed.setFixedWidth(44)
        self.seed.setValidator(QIntValidator(0, 999_999, self.seed))
        self.seed.settle("0")
        self.seed.setToolTip("Draws the jitter of the world; the same seed gives the same run")
        self.seed.setAccessibleName("Seed")
        across.addWidget(self.seed)
        across.addStretch(1)
        self.phase = QLabel()
        self.phase.setProperty("role", "phase")
        self.phase.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.phase.setFixedHeight(32)
        across.addWidget(self.phase)
        self.by_hand = QToolButton()
        self.by_hand.setText("By hand")
        self.by_hand.setProperty("role", "tool")
        self.by_hand.setFixedHeight(32)
        self.by_hand.setCheckable(True)
        self.by_hand.setToolTip("Nothing moves until you choose an operation: click its arrow")
        self.by_hand.toggled.connect(self.by_hand_changed)
        across.addWidget(self.by_hand)
        self.speed = Combo()
        self.speed.setFixedWidth(68)
        self.speed.setToolTip("Simulated seconds for each second")
        self.speed.setAccessibleName("Speed")
        for words, factor in SPEEDS.items():
            self.speed.addItem(words, factor)
        self.speed.setCurrentText("1×")
        self.speed.currentIndexChanged.connect(
            lambda _: self.speed_changed.emit(self.speed.currentData())
        )
        across.addWidget(self.speed)
        self.step = KeyButton("Step", "F10", "step", "", tokens)
        self.step.setToolTip("One operation, then pause (F10)")
        self.step.clicked.connect(self.step_wanted)
        self.play = KeyButton("Play", "F5", "play", "primary", tokens)
        self.play.setFixedWidth(112)
        self.play.clicked.connect(
            lambda: self.pause_wanted.emit() if self._running else self.play_wanted.emit()
        )
        self.stop = KeyButton("Stop", "F8", "stop", "stop", tokens)
        self.stop.setFixedWidth(136)
        self.stop.clicked.connect(self.stop_wanted)
        for part in (self.step, self.play, rule(vertical=True, length=24), self.stop):
            across.addWidget(part)
        self._name_play()
        self.show_phase("", exists=False)

    def offer(
        self,
        worlds: Sequence[str],
        starts: Sequence[tuple[str, str]],
        goals: Sequence[tuple[str, str]],
    ) -> None:
        """Fill the choices with pairs (what is shown, address); the first one is the default.

        What a person chose is kept where it still exists.
        """
        _fill(self.world, [(name, name) for name in worlds])
        _fill(self.start, starts)
        _fill(self.goal, goals)

    def lock(self, locked: bool) -> None:
        """While a run exists, what it started from cannot be changed."""
        for widget in (self.world, self.start, self.goal, self.seed):
            widget.setEnabled(not locked)

    def show_phase(self, phase: str, exists: bool, tip: str = "") -> None:
        """Show how the run stands; ``exists`` says whether there is one to stop."""
        words, kind = PHASES.get(phase, (phase.replace("_", " ").capitalize(), "quiet"))
        self.phase.setText(f"●  {words}" if kind != "quiet" else words)
        self.phase.setToolTip(tip)
        if self.phase.property("kind") != kind:
            self.phase.setProperty("kind", kind)
            self.phase.style().unpolish(self.phase)
            self.phase.style().polish(self.phase)
        self.stop.setToolTip(
            "A controlled stop, at any time (F8)" if exists else "Nothing runs now"
        )
        running = phase in ("running", "opening", "ready")
        if running != self._running:
            self._running = running
            self._name_play()

    def set_tokens(self, tokens: Tokens) -> None:
        for button in (self.step, self.play, self.stop):
            button.set_tokens(tokens)

    def _name_play(self) -> None:
        words = "Pause" if self._running else "Play"
        self.play.set_words(words, "F6" if self._running else "F5", words.lower())
        tip = "Hold the run at the next tick (F6)" if self._running else "Run to the goal (F5)"
        self.play.setToolTip(tip)

    def _choice(self, across: QHBoxLayout, words: str, width: int, tip: str) -> Combo:
        across.addWidget(label(words, "small"))
        combo = Combo()
        combo.setMinimumWidth(width)
        combo.setSizeAdjustPolicy(Combo.SizeAdjustPolicy.AdjustToContents)
        combo.setMaximumWidth(LONGEST)
        combo.setToolTip(tip)
        combo.setAccessibleName(words)
        across.addWidget(combo)
        return combo


def _fill(combo: Combo, items: Sequence[tuple[str, str]]) -> None:
    """Replace the items; keeps a choice that was made and still exists, else takes the first."""
    before = combo.currentData() if combo.currentIndex() > 0 else None
    blocked = combo.blockSignals(True)
    combo.clear()
    for words, data in items:
        combo.addItem(words, data)
    known = [data for _, data in items]
    combo.setCurrentIndex(known.index(before) if before in known else 0)
    combo.blockSignals(blocked)
