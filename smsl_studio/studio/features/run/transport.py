"""The transport: choices for the next run, speed, and the buttons step, play, pause and stop."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QFontMetrics, QIntValidator, QResizeEvent
from PySide6.QtWidgets import QHBoxLayout, QLabel, QSizePolicy, QToolButton, QWidget

from smsl_studio.front.views.phase_words import phase_words
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Combo, Field, label, rule
from smsl_studio.studio.base.key_button import KeyButton, command_button
from smsl_studio.studio.base.precedence import Precedence
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.features.run.more_choices import MoreChoices
from smsl_studio.studio.running.phase_badge import PhaseBadge
from smsl_studio.studio.running.runner import FASTEST

SPEEDS = {"¼×": 0.25, "½×": 0.5, "1×": 1.0, "2×": 2.0, "4×": 4.0, "8×": 8.0, "Max": FASTEST}
LONGEST = 150
WIDE, NARROW, SEEDED, NARROWEST, BARE = 1140, 990, 850, 720, 400
"""Widths (pixels) from which choices have labels, buttons have words, the seed is shown, choices
are shown at all, and buttons have their keys."""


class Transport(QWidget):
    """The row of Run mode in the mode bar. It offers choices and emits what was pressed."""

    play_wanted = Signal()
    pause_wanted = Signal()
    step_wanted = Signal()
    stop_wanted = Signal()
    speed_changed = Signal(float)
    by_hand_changed = Signal(bool)

    offered = Signal()
    """Other choices are offered."""

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._running = self._stopped = False
        self._labels: list[QLabel] = []
        self._choices = QWidget()
        self._choices.setMinimumWidth(0)
        self._choices.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        chosen = QHBoxLayout(self._choices)
        chosen.setContentsMargins(0, 0, 0, 0)
        chosen.setSpacing(8)
        self.world = self._choice(chosen, "World", 92, "Where the blueprint is run")
        self.start = self._choice(chosen, "Start", 60, "The state the run starts in")
        self.goal = self._choice(chosen, "Goal", 60, "The state the run ends in")
        self.seed = self._seed(chosen)
        chosen.addStretch(1)
        across = QHBoxLayout(self)
        across.setContentsMargins(0, 0, 0, 0)
        across.setSpacing(8)
        across.addWidget(self._choices, 1)
        across.addStretch(0)
        self.phase = PhaseBadge()
        across.addWidget(self.phase)
        self.by_hand = self._by_hand()
        self.speed = self._speed()
        choices = self.world, self.start, self.goal, self.speed
        self.more = MoreChoices(self.seed, self.by_hand, *choices)
        self.step = command_button("step", "", tokens)
        self.step.setToolTip("One operation, then pause (F10)")
        self.step.clicked.connect(self.step_wanted)
        self.play = KeyButton("Play", "F5", "play", "primary", tokens)
        self.play.setMinimumWidth(112)
        self.play.clicked.connect(
            lambda: self.pause_wanted.emit() if self._running else self.play_wanted.emit()
        )
        self.stop = command_button("stop", "stop", tokens)
        self.stop.setFixedWidth(136)
        self.stop.clicked.connect(self.stop_wanted)
        line = rule(vertical=True, length=24)
        for part in (self.more, self.by_hand, self.speed, self.step, self.play, line, self.stop):
            across.addWidget(part)
        self._precedence = Precedence(
            self, self._choices, line, self.speed, self.by_hand, self.step,
            self.more, self.phase, self.play,
        )  # fmt: skip
        self._name_play()
        self.show_phase("", exists=False)

    def offer(
        self,
        worlds: Sequence[tuple[str, str]],
        starts: Sequence[tuple[str, str]],
        goals: Sequence[tuple[str, str]],
    ) -> None:
        """Fill the choices with pairs (text, data); the first is the default.

        A choice that a person made stays if it still exists.
        """
        _fill(self.world, worlds)
        _fill(self.start, starts)
        _fill(self.goal, goals)
        self.offered.emit()

    def choose_start(self, start: str) -> None:
        """Select a start if it is in the list."""
        at = self.start.findData(start)
        if at >= 0:
            self.start.setCurrentIndex(at)

    def show_choice(self, world: str, start: str, goal: str, seed: int) -> None:
        """Show what a run was begun with; an empty address is the default."""
        for combo, data in ((self.world, world), (self.start, start), (self.goal, goal)):
            at = combo.findData(data) if data else 0
            if at >= 0 and at != combo.currentIndex():
                combo.setCurrentIndex(at)
        if self.seed.text() != str(seed):
            self.seed.settle(str(seed))

    def lock(self, locked: bool) -> None:
        """Lock or unlock the choices. A run keeps those it was begun with."""
        for widget in (self.world, self.start, self.goal, self.seed):
            widget.setEnabled(not locked)

    def show_phase(self, phase: str, exists: bool, tip: str = "", over: bool = False) -> None:
        """Show the phase of the run; ``exists`` says whether there is one to stop, ``over``
        whether it has ended."""
        self.phase.show_phase(*phase_words(phase, over), tip)
        self.stop.setEnabled(exists)
        self.stop.setToolTip(
            tip_text("A controlled stop, at any time (F8)" if exists else "Nothing runs now")
        )
        # As in Supervise mode: a task for a person can be held, and what a person has taken over
        # is given back there, so these commands would be refused.
        running = phase in ("running", "opening") or (exists and phase == "waiting")
        stopped, taken = exists and phase == "stopped", exists and phase == "taken_over"
        for button in (self.step, self.play):
            self._precedence.want(button, not taken)
        if (running, stopped) != (self._running, self._stopped):
            self._running, self._stopped = running, stopped
            self._name_play()
            self._shorten()
        self._precedence.fit()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        for button in (self.step, self.play, self.stop):
            button.set_tokens(tokens)

    def _name_play(self) -> None:
        if self._running:
            words, key, tip = "Pause", "F6", "Hold the run at the next tick (F6)"
        elif self._stopped:
            words, key, tip = "Reset", "F5", "Unlatch the stop; the run is then paused (F5)"
        else:
            words, key, tip = "Play", "F5", "Run to the goal (F5)"
        self.play.set_words(words, key, "pause" if self._running else "play")
        self.play.setToolTip(tip_text(tip))

    def resizeEvent(self, event: QResizeEvent) -> None:
        """In a narrow row first words are hidden, then buttons; Stop never is."""
        super().resizeEvent(event)
        wide = self.width()
        for words in self._labels:
            words.setVisible(wide >= WIDE)
        self._shorten()
        self.phase.set_brief(wide < BARE)
        self.seed.setVisible(wide >= SEEDED)
        self.play.setMinimumWidth(112 if wide >= NARROW else 0)
        self.more.set_brief(wide < BARE)
        self._precedence.want(self._choices, wide >= NARROWEST)
        self._precedence.want(self.more, wide < NARROWEST)
        self._precedence.fit()

    def _shorten(self) -> None:
        """Hide the words of Step and Play in a narrow row. Those of Reset stay in place of its key,
        because its icon and key are those of Play."""
        wide = self.width()
        self.step.set_short(wide < NARROW, wide < BARE)
        self.play.set_short(wide < NARROW, wide < BARE, worded=self._stopped)

    def _by_hand(self) -> QToolButton:
        button = QToolButton()
        button.setText("By hand")
        button.setProperty("role", "tool")
        button.setFixedHeight(32)
        button.setCheckable(True)
        button.setToolTip("Nothing moves until you choose an operation: click its arrow")
        button.toggled.connect(self.by_hand_changed)
        return button

    def _speed(self) -> Combo:
        speed = Combo()
        speed.setFixedWidth(64)
        speed.setToolTip(
            "Simulated seconds for each second; without physics, how fast operations are shown"
        )
        speed.setAccessibleName("Speed")
        for words, factor in SPEEDS.items():
            speed.addItem(words, factor)
        speed.setCurrentText("1×")
        speed.currentIndexChanged.connect(lambda _: self.speed_changed.emit(speed.currentData()))
        return speed

    def _seed(self, across: QHBoxLayout) -> Field:
        self._label(across, "Seed")
        seed = Field()
        seed.setFixedWidth(44)
        seed.setValidator(QIntValidator(0, 999_999, seed))
        seed.settle("0")
        seed.setToolTip("Draws the jitter of the world; the same seed gives the same run")
        seed.setAccessibleName("Seed")
        across.addWidget(seed)
        return seed

    def _label(self, across: QHBoxLayout, words: str) -> None:
        self._labels.append(label(words, "small"))
        across.addWidget(self._labels[-1])

    def _choice(self, across: QHBoxLayout, words: str, width: int, tip: str) -> _Choice:
        self._label(across, words)
        combo = _Choice(width, tip)
        combo.setAccessibleName(plain_text(words))
        self._labels[-1].setBuddy(combo)
        across.addWidget(combo)
        return combo


class _Choice(Combo):
    """A combo box as wide as its longest entry, within limits."""

    def __init__(self, least: int, tip: str) -> None:
        super().__init__()
        self._least, self._tip = least, tip
        self.currentTextChanged.connect(lambda _: self.say())
        self.say()
        self.setMinimumWidth(least)
        self.setMaximumWidth(LONGEST)

    def say(self) -> None:
        """Put the whole of the present choice into the tooltip."""
        chosen = self.currentText()
        self.setToolTip(tip_text(f"{self._tip}: {chosen}" if chosen else self._tip))

    def words_in(self, room: int, metrics: QFontMetrics) -> str:
        """The whole choice if it has room, else the name of the state, or the last word, alone.

        The tooltip has the whole choice.
        """
        whole = plain_text(self.currentText())
        if metrics.horizontalAdvance(whole) <= room:
            return whole
        name = whole.rpartition("/")[2].rpartition(" ")[2]
        return metrics.elidedText(name, Qt.TextElideMode.ElideRight, room)

    def sizeHint(self) -> QSize:
        """The width of the longest entry, within limits."""
        metrics = self.fontMetrics()
        words = (self.itemText(at) for at in range(min(self.count(), 500)))
        widest = max((metrics.horizontalAdvance(text) for text in words), default=0) + 38
        return QSize(min(max(widest, self._least), LONGEST), super().sizeHint().height())


def _fill(combo: _Choice, items: Sequence[tuple[str, str]]) -> None:
    """Replace the items.

    A choice that was made stays if it still exists, else the first is selected.
    """
    before = combo.currentData() if combo.currentIndex() > 0 else None
    blocked = combo.blockSignals(True)
    combo.clear()
    for words, data in items:
        combo.addItem(words, data)
    known = [data for _, data in items]
    combo.setCurrentIndex(known.index(before) if before in known else 0)
    combo.blockSignals(blocked)
    combo.say()
    combo.updateGeometry()
