"""ChoiceHold: keeps a run at its moment while a person chooses, and says so."""

from __future__ import annotations

from PySide6.QtWidgets import QHBoxLayout, QPushButton, QWidget

from smsl_studio.runlog.events import Event
from smsl_studio.runlog.regulation import Commanded
from smsl_studio.studio.base.controls import label
from smsl_studio.studio.running.run_session import RunSession

HELD = "The run is held at {time:.2f} s while you choose. It goes on when you close this."
SOON = "The run is held as soon as it can be."
ON = "The run goes on while you choose."
PAUSED = "The run is paused at {time:.2f} s, and stays so."
OTHERS = ("pause", "inject", "disturb")
"""Commands that do not take the hold over from this line."""


class ChoiceHold(QWidget):
    """A line that says whether the run goes on, with a button that holds it or lets it go on.

    A hold ends with ``end``, unless the person has given the run another command meanwhile.
    """

    def __init__(self, run: RunSession, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._run = run
        self._ours = self._ending = False
        self.words = label("", "hint")
        self.button = QPushButton("")
        self.button.setAutoDefault(False)
        self.button.clicked.connect(self._press)
        across = QHBoxLayout(self)
        across.setContentsMargins(0, 0, 0, 0)
        across.setSpacing(12)
        across.addWidget(self.words, 1)
        across.addWidget(self.button)
        run.changed.connect(self.refresh)
        run.exists_changed.connect(lambda _: self.refresh())
        run.events_told.connect(self._hear)

    def begin(self) -> None:
        """Hold the run, if it goes on."""
        self._ending = False
        if self._run.exists and self._run.phase == "running" and not self._ours:
            self._ours = True
            self._run.pause()
        self.refresh()

    def end(self) -> None:
        """Let the run go on, if this line holds it."""
        self._ending = self._ours
        self.refresh()

    def forget(self) -> None:
        """Leave the run as it is."""
        self._ours = self._ending = False

    def refresh(self) -> None:
        """Say what the run does."""
        run = self._run
        moves = run.exists and run.phase == "running"
        paused = run.exists and run.phase == "paused"
        if not moves and not paused:
            self.forget()
        if self._ending and paused:
            self.forget()
            run.resume()
        if moves:
            self.words.setText(SOON if self._ours else ON)
        elif paused:
            self.words.setText((HELD if self._ours else PAUSED).format(time=run.time))
        self.button.setText("Hold it" if moves else "Go on now")
        self.button.setVisible(moves != self._ours)
        self.setVisible(moves or paused)

    def _press(self) -> None:
        if self._ours:
            self.forget()
            self._run.resume()
        else:
            self.begin()

    def _hear(self, events: tuple[Event, ...]) -> None:
        for event in events:
            if isinstance(event, Commanded):
                refused = event.command == "pause" and bool(event.refused)
                if refused or (event.command not in OTHERS and not event.refused):
                    self.forget()
