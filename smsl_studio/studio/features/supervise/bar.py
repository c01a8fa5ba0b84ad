"""The row of Supervise mode in the mode bar: goal, supervisor, phase, step, pause, stop."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QHBoxLayout, QPushButton, QToolButton, QWidget

from smsl_studio.front.views.phase_words import phase_words
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import label, rule
from smsl_studio.studio.base.icons import icon
from smsl_studio.studio.base.key_button import command_button
from smsl_studio.studio.base.precedence import Precedence
from smsl_studio.studio.base.theme import CONTROL_DECISION, Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.running.frames import tool
from smsl_studio.studio.running.phase_badge import PhaseBadge
from smsl_studio.studio.running.run_session import RunSession

NARROW, BARE = 620, 400
"""The widths from which the buttons have words, and keys (pixels)."""
LONGEST = 170
"""Largest width of the goal and of the name (pixels); in a wide bar a quarter of it."""


class SuperviseBar(QWidget):
    """The row. Stop has the same place and size as in Run mode."""

    step_wanted = Signal()
    play_wanted = Signal()
    pause_wanted = Signal()
    stop_wanted = Signal()
    reset_wanted = Signal()
    end_wanted = Signal()

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._tokens = tokens
        self._pauses = False
        self._goal, self._person = label("", "strong"), label("", "strong")
        self._said = [label("Goal", "small"), label("Supervisor", "small")]
        self.phase = PhaseBadge()
        self.views = tool("", "eye", "What is shown: partial view, text, scene", tokens)
        self.views.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self.views.setFixedHeight(CONTROL_DECISION)
        self.step = command_button("step", "", tokens)
        self.step.setToolTip("One operation, then pause (F10)")
        self.step.clicked.connect(self.step_wanted)
        self.play = command_button("resume", "", tokens)
        self.play.clicked.connect(self._play_or_pause)
        self.reset, self.end = QPushButton("Reset"), QPushButton("End run")
        for pressed in (self.reset, self.end, self.step, self.play):
            # Enter presses the button with the focus, as in the page.
            pressed.setAutoDefault(True)
        self.reset.setToolTip("Unlatch the stop; the run is then paused")
        self.end.setToolTip("End the run for good")
        self.reset.clicked.connect(self.reset_wanted)
        self.end.clicked.connect(self.end_wanted)
        self.stop = command_button("stop", "stop", tokens)
        self.stop.setFixedWidth(136)
        self.stop.clicked.connect(self.stop_wanted)
        across = QHBoxLayout(self)
        across.setContentsMargins(0, 0, 0, 0)
        across.setSpacing(8)
        across.addWidget(self._said[0])
        across.addWidget(self._goal)
        across.addSpacing(4)
        across.addWidget(self._said[1])
        across.addWidget(self._person)
        across.addStretch(1)
        across.addWidget(self.views)
        across.addWidget(self.phase)
        for button in (self.reset, self.end):
            button.setFixedHeight(CONTROL_DECISION)
            across.addWidget(button)
        across.addWidget(self.step)
        across.addWidget(self.play)
        line = rule(vertical=True, length=24)
        across.addWidget(line)
        across.addWidget(self.stop)
        self._precedence = Precedence(
            self, self._said[1], self._person, self._said[0], self._goal, line, self.views,
            self.step, self.end, self.phase, self.play, self.reset, gaps=4,
        )  # fmt: skip
        self.show_run("", exists=False, over=False, tip="", goal="", person="")

    def show_status(self, run: RunSession) -> None:
        """Show a run as it stands."""
        status, person = run.status, run.who()
        goals = ", ".join(goal.state for goal in status.goals) if status is not None else ""
        named = "" if person == "a person" else person
        self.show_run(run.phase, run.exists, run.over, run.sentence, goals, named)

    def show_run(
        self, phase: str, exists: bool, over: bool, tip: str, goal: str, person: str
    ) -> None:
        """Show the phase of the run, its goal, and the person who commands; ``over`` says that it
        has ended."""
        self.phase.show_phase(*phase_words(phase, over), tip)
        pairs = ((self._goal, goal), (self._person, person))
        for before, (part, said) in zip(self._said, pairs, strict=True):
            part.setToolTip(tip_text(said))
            metrics = part.fontMetrics()
            room = max(LONGEST, self.width() // 4)
            part.setText(metrics.elidedText(plain_text(said), Qt.TextElideMode.ElideMiddle, room))
            self._precedence.want(part, bool(said))
            self._precedence.want(before, bool(said))
        latched = phase == "stopped" and exists
        for button in (self.reset, self.end):
            self._precedence.want(button, latched)
        # Commands that would be refused are hidden. Giving back is done in Step in.
        for button in (self.step, self.play):
            self._precedence.want(button, not latched and phase != "taken_over")
        self._pauses = exists and phase in ("running", "opening", "waiting")
        if self._pauses:
            self.play.set_words("Pause", "F6", "pause")
            self.play.setToolTip("Hold the run at the next tick (F6)")
        else:
            words = {"paused": "Resume", "ready": "Play"}.get(phase, "Resume")
            self.play.set_words(words if exists else "Run", "F5", "play")
            self.play.setToolTip(tip_text("Go on (F5)" if exists else "Run to the goal (F5)"))
        tip = "A controlled stop, at any time (F8)" if exists else "Nothing runs now"
        self.stop.setToolTip(tip_text(tip))
        self.stop.setEnabled(exists)
        self._precedence.fit()

    @property
    def person(self) -> str:
        """The name of the person who commands; empty if nobody gave a name."""
        return self._person.text()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.views.setIcon(icon("eye", tokens))
        for button in (self.step, self.play, self.stop):
            button.set_tokens(tokens)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """In a narrow row first words are hidden, then buttons; Stop never is."""
        super().resizeEvent(event)
        for button in (self.step, self.play):
            button.set_short(self.width() < NARROW, self.width() < BARE)
        self.phase.set_brief(self.width() < BARE)
        self._precedence.fit()

    def _play_or_pause(self) -> None:
        (self.pause_wanted if self._pauses else self.play_wanted).emit()
