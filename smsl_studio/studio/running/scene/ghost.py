"""The ghost: how a forecast moves the things of a world, shown once and then at its end."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import QElapsedTimer, QObject, QTimer, Signal

from smsl_studio.studio.base.calm import is_calm
from smsl_studio.studio.running.scene.kept_poses import KeptPoses

EVERY = 0.05
"""Simulated seconds between two poses of a forecast."""
FRAME = 40
"""Milliseconds between two pictures while the ghost moves."""
LONGEST = 6.0
"""A forecast that takes longer (seconds) is shown faster."""
POINTS = 60
"""The largest number of points of a path."""
NOW, FORECAST, BOTH = "Now", "Forecast", "Both"
SEEN = (NOW, FORECAST, BOTH)
"""What a scene shows: things where they are, where they will be, or both."""


@dataclass(frozen=True)
class GhostPlace:
    """Where the ghost is: poses after so many of all simulated seconds, and which things are seen.

    ``path`` are the poses from the beginning to the end, in a few steps.
    """

    poses: tuple[float, ...]
    time: float
    seconds: float
    path: tuple[tuple[float, ...], ...] = ()
    alone: bool = False

    @property
    def words(self) -> str:
        """The words beside the ghost."""
        return f"Forecast at {self.time:.1f} s"


class Ghost(QObject):
    """Plays the poses of one forecast once, then stays at their end. It moves nothing else."""

    moved = Signal()
    """The result of ``place`` or ``playing`` has changed."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._frames: KeptPoses | None = None
        self._path: tuple[tuple[float, ...], ...] = ()
        self._time = 0.0
        self._seen = BOTH
        self._clock = QElapsedTimer()
        self._timer = QTimer(self)
        self._timer.setInterval(FRAME)
        self._timer.timeout.connect(lambda: self.go_on(self._clock.elapsed() / 1000))

    @property
    def seconds(self) -> float:
        """The simulated seconds of the forecast; 0 without one."""
        return self._frames.seconds if self._frames is not None else 0.0

    @property
    def time(self) -> float:
        """The simulated seconds at which the ghost is."""
        return self._time

    @property
    def playing(self) -> bool:
        """Whether it moves by itself now."""
        return self._timer.isActive()

    @property
    def seen(self) -> str:
        """One of ``SEEN``."""
        return self._seen

    @seen.setter
    def seen(self, what: str) -> None:
        """Show things where they are, where they will be, or both."""
        self._seen = what
        self.moved.emit()

    @property
    def place(self) -> GhostPlace | None:
        """Where it is; None if it is not to be seen."""
        frames = self._frames
        if frames is None or self._seen == NOW:
            return None
        alone = self._seen == FORECAST
        return GhostPlace(frames.at(self._time), self._time, frames.seconds, self._path, alone)

    def show(self, frames: KeptPoses | None) -> None:
        """Show the poses of another forecast, and play them once. None, or fewer than two poses,
        show no ghost."""
        shown = frames if frames is not None and len(frames) > 1 else None
        if shown is self._frames:
            return
        self._frames = shown
        self._path = tuple(shown.spread(POINTS)) if shown is not None else ()
        if shown is None:
            self._timer.stop()
            self._time = 0.0
            self.moved.emit()
        else:
            self.play()

    def play(self) -> None:
        """Move from the beginning to the end; who wants less motion sees the end at once."""
        self._timer.stop()
        if is_calm():
            self._time = self.seconds
        else:
            self._time = 0.0
            self._clock.restart()
            self._timer.start()
        self.moved.emit()

    def go_on(self, wall: float) -> None:
        """Be where the ghost is so many wall seconds after its beginning."""
        self._time = min(wall * max(self.seconds / LONGEST, 1.0), self.seconds)
        if self._time >= self.seconds:
            self._timer.stop()
        self.moved.emit()

    def seek(self, time: float) -> None:
        """Stand still at a simulated second."""
        self._timer.stop()
        self._time = min(max(time, 0.0), self.seconds)
        self.moved.emit()
