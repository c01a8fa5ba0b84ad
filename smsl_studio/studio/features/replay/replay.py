"""Replay: one recorded run, the present moment in it, whether it plays, and how fast."""

from __future__ import annotations

from dataclasses import replace
from time import monotonic

from PySide6.QtCore import QObject, QTimer, Signal

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.execution.status import DispatchStatus
from smsl_studio.dispatch.status_then import status_at
from smsl_studio.front.recordings import Recording
from smsl_studio.runlog.history import RunHistory, Story
from smsl_studio.runlog.moment import RunMoment

FRAME = 33
"""Milliseconds between two moments while it plays."""
NOTHING = Story(RunMoment(), RunHistory())


class Replay(QObject):
    """A ``ShownRun`` that cannot be commanded.

    ``index`` is the number of events that have happened. ``time`` is the shown simulated time in
    seconds. While the replay plays, it also advances between two events.
    """

    changed = Signal()
    """The moment or the recording changed."""
    opened = Signal()
    """Another recording is shown from its beginning, or none."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.recording: Recording | None = None
        self.status: DispatchStatus | None = None
        self.story = NOTHING
        self.time, self.speed = 0.0, 1.0
        self._last = 0.0
        self._clock = QTimer(self)
        self._clock.setInterval(FRAME)
        self._clock.timeout.connect(self._go_on)

    @property
    def blueprint(self) -> Blueprint | None:
        """The blueprint of the recorded run; None without a recording."""
        return self.recording.blueprint if self.recording is not None else None

    @property
    def shown(self) -> bool:
        """Whether there is a recording."""
        return self.recording is not None

    @property
    def foreign(self) -> bool:
        """False: a replay has no other drawing."""
        return False

    def is_another(self, drawn: Blueprint) -> bool:
        """False: what is shown is what was recorded."""
        return False

    @property
    def exists(self) -> bool:
        """False: a recorded run cannot be commanded."""
        return False

    @property
    def phase(self) -> str:
        """The phase of the run at this moment in one word; empty without a recording."""
        return self.story.moment.phase if self.recording is not None else ""

    @property
    def sentence(self) -> str:
        """Why the run held or ended at this moment."""
        return self.story.moment.sentence

    @property
    def index(self) -> int:
        """The number of events that have happened at this moment."""
        return self.story.moment.index

    @property
    def count(self) -> int:
        """The number of events in the recording."""
        return len(self.recording.playback) if self.recording is not None else 0

    @property
    def end(self) -> float:
        """The end of the recording in simulated seconds."""
        return self.recording.playback.end if self.recording is not None else 0.0

    @property
    def playing(self) -> bool:
        """Whether the replay plays."""
        return self._clock.isActive()

    def show(self, recording: Recording | None) -> None:
        """Show a recording from its beginning; None shows none."""
        self._clock.stop()
        self.recording = recording
        self.status, self.story, self.time = None, NOTHING, 0.0
        self.opened.emit()
        self.to_time(0.0)

    def play(self) -> None:
        """Play; from the end it begins again."""
        if self.recording is None:
            return
        if self.index >= self.count:
            self.to_index(0)
        self._last = monotonic()
        self._clock.start()
        self.changed.emit()

    def pause(self) -> None:
        """Pause at the present moment."""
        self._clock.stop()
        self.changed.emit()

    def turn(self) -> None:
        """Pause if it plays, else play."""
        if self.playing:
            self.pause()
        else:
            self.play()

    def step(self, events: int = 1) -> None:
        """Go so many events forward, or back if negative, and pause there."""
        self._clock.stop()
        self.to_index(self.index + events)

    def to_index(self, index: int) -> None:
        """Show the run after its first ``index`` events."""
        if self.recording is not None:
            moment = self.recording.playback.at(index)
            self._show(moment, moment.time)

    def to_time(self, time: float) -> None:
        """Show the run at a simulated time in seconds."""
        if self.recording is not None:
            time = min(max(time, 0.0), self.end)
            playback = self.recording.playback
            self._show(playback.at(playback.index_at(time)), time)

    def set_speed(self, speed: float) -> None:
        """Set the simulated seconds per wall second."""
        self.speed = speed

    def _show(self, moment: RunMoment, time: float) -> None:
        assert self.recording is not None
        if moment.index != self.index or self.status is None:
            self.status = status_at(self.recording.blueprint, moment)
            self.story = Story(moment, self.recording.history)
        self.time = time
        self.status = replace(self.status, time=max(time, moment.time))
        self.changed.emit()

    def _go_on(self) -> None:
        now = monotonic()
        time = self.time + (now - self._last) * self.speed
        self._last = now
        if time >= self.end:
            self._clock.stop()
            self.to_index(self.count)
        else:
            self.to_time(time)
