"""The transport of a replay: scrubber, play, steps and speed."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QHBoxLayout, QLabel, QPushButton, QSizePolicy, QWidget

from smsl_studio.front.views.phase_words import phase_words
from smsl_studio.studio.base.controls import Combo, Label, label, rule
from smsl_studio.studio.base.key_button import KeyButton
from smsl_studio.studio.base.precedence import Precedence
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.features.replay.replay import Replay
from smsl_studio.studio.features.replay.scrubber import Scrubber

SPEEDS = {"¼×": 0.25, "½×": 0.5, "1×": 1.0, "2×": 2.0, "4×": 4.0, "16×": 16.0, "64×": 64.0}
MARK = "REPLAY"
WIDE, NARROW = 1140, 780
"""Widths (pixels) from which buttons have words, and from which the phase is shown."""


class ReplayTransport(QWidget):
    """The row of Replay mode in the mode bar."""

    close_wanted = Signal()

    def __init__(self, replay: Replay, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._replay = replay
        self.mark = _chip(MARK, "unknown")
        self.mark.setToolTip("What is shown was recorded. Nothing can be commanded here")
        self.scrubber = Scrubber(tokens)
        self.moment = label("", "mono")
        self.moment.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        self.moment.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self.phase = _chip("", "quiet")
        self.speed = Combo()
        for words, speed in SPEEDS.items():
            self.speed.addItem(words, speed)
        self.speed.setCurrentIndex(list(SPEEDS).index("1×"))
        self.speed.setFixedWidth(76)
        self.speed.setAccessibleName("Speed of the replay")
        self.speed.setToolTip("Simulated seconds a second")
        self.back = KeyButton("Back", "⇧F10", "step-back", "", tokens)
        self.back.setToolTip("One event back (Shift+F10)")
        self.step = KeyButton("Step", "F10", "step", "", tokens)
        self.step.setToolTip("One event forward (F10)")
        self.play = KeyButton("Play", "F5", "play", "primary", tokens)
        self.play.setMinimumWidth(112)
        self.leave = QPushButton("Close replay")
        self.leave.setFixedHeight(32)
        self.leave.setToolTip("Close the recording")
        across = QHBoxLayout(self)
        across.setContentsMargins(0, 0, 0, 0)
        across.setSpacing(8)
        line = rule(vertical=True, length=24)
        parts = (self.mark, self.scrubber, self.moment, self.phase, self.speed, self.back,
                 self.step, self.play, line, self.leave)  # fmt: skip
        for part in parts:
            across.addWidget(part, 1 if part is self.scrubber else 0)
        self._precedence = Precedence(
            self, self.phase, self.speed, line, self.moment, self.back, self.step, self.mark,
            self.scrubber,
        )  # fmt: skip
        self._connect()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        for part in (self.scrubber, self.back, self.step, self.play):
            part.set_tokens(tokens)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep room for the scrubber: in a narrow bar the other parts are shorter or hidden."""
        super().resizeEvent(event)
        for button in (self.back, self.step, self.play):
            button.set_short(self.width() < WIDE)
        self.play.setMinimumWidth(112 if self.width() >= WIDE else 0)
        self._precedence.want(self.phase, self.width() >= NARROW)
        self.leave.setText("Close replay" if self.width() >= WIDE else "Close")
        self._precedence.fit()

    def _connect(self) -> None:
        replay = self._replay
        self.scrubber.time_wanted.connect(replay.to_time)
        self.play.clicked.connect(replay.turn)
        self.step.clicked.connect(lambda: replay.step(1))
        self.back.clicked.connect(lambda: replay.step(-1))
        self.speed.currentIndexChanged.connect(lambda _: replay.set_speed(self.speed.currentData()))
        self.leave.clicked.connect(self.close_wanted)
        replay.opened.connect(self._show_run)
        replay.changed.connect(self._show_moment)

    def _show_run(self) -> None:
        recording = self._replay.recording
        self.scrubber.show_run(self._replay.end, recording.marks if recording is not None else ())

    def _show_moment(self) -> None:
        replay = self._replay
        self.scrubber.show_time(replay.time)
        self.moment.setText(f"{replay.time:{len(f'{replay.end:.2f}')}.2f} of {replay.end:.2f} s")
        self.back.setEnabled(replay.index > 0)
        self.step.setEnabled(replay.index < replay.count)
        words, kind = phase_words(replay.phase, replay.story.moment.finished is not None)
        self.phase.setText(words)
        self.phase.setToolTip(tip_text(replay.sentence))
        if self.phase.property("kind") != kind:
            self.phase.setProperty("kind", kind)
            self.phase.style().unpolish(self.phase)
            self.phase.style().polish(self.phase)
        turn = ("Pause", "F6", "pause") if replay.playing else ("Play", "F5", "play")
        self.play.set_words(*turn)


def _chip(words: str, kind: str) -> QLabel:
    chip = Label(words)
    chip.setProperty("role", "phase")
    chip.setProperty("kind", kind)
    chip.setAlignment(Qt.AlignmentFlag.AlignCenter)
    chip.setFixedHeight(32)
    chip.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
    return chip
