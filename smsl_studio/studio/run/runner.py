"""The loop of a run in the window: it owns the dispatcher, paces it, and hands on what happened.

The dispatcher lives in this thread and its world in a child process, so that neither can hold up
the window. Wall time only paces: it decides when a tick is taken, never what the tick does.
"""

from __future__ import annotations

import math
import queue
import threading
from collections.abc import Callable
from dataclasses import replace
from time import monotonic

from PySide6.QtCore import QObject, QThread, Signal

from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.dispatch.status import DispatchStatus
from smsl_studio.errors import SaveError, StudioError
from smsl_studio.front.recording import Recording
from smsl_studio.front.script.acting import Acting
from smsl_studio.runlog.events import Event, RunFinished
from smsl_studio.runlog.log import RunLog

FRAME = 1 / 30
"""Wall seconds between two reports to the window."""
WATCH = 0.05
"""Wall seconds between two looks at the world's process while a run stands still."""
LAG = 0.25
"""Wall seconds a run may fall behind its pace before it stops trying to catch up."""
FASTEST = 1e6
"""Stands for "as fast as it can", in simulated seconds per wall second."""

Command = Callable[[Dispatcher], None]
News = tuple[tuple[Event, ...], DispatchStatus]
CLOSED = "The window let go of the run while it went on."


def _no_log() -> None:
    """Runs that nobody records."""


class Runner(QThread):
    """Runs one dispatcher until it is closed. Commands may be given from the window's thread.

    ``make`` and ``record`` are called in the runner's thread: the dispatcher, and the log into
    which the run is recorded. SaveError of ``record`` refuses the start. ``acting`` is a script
    under which the run goes.
    """

    opened = Signal(object)
    """The dispatcher, once its world stands (read ``host.poses`` and ``opened`` from it only)."""
    refused = Signal(object)
    """A StudioError: the run could not be opened."""
    broke = Signal(object)
    """An error nobody expected; the run is over."""

    def __init__(
        self,
        make: Callable[[], Dispatcher],
        speed: float,
        parent: QObject | None = None,
        record: Callable[[], RunLog | None] = _no_log,
        acting: Acting | None = None,
    ) -> None:
        super().__init__(parent)
        self._make, self._record, self._acting = make, record, acting
        self._speed = speed
        self._commands: queue.SimpleQueue[Command | None] = queue.SimpleQueue()
        self._closing = False
        self._dispatcher: Dispatcher | None = None
        self._lock = threading.Lock()
        self._news: News | None = None
        self.latency = 0.0
        """Wall seconds the slowest of the newest ticks took, from command to answer."""

    def command(self, command: Command) -> None:
        """Have the loop call ``command`` before its next tick."""
        self._commands.put(command)

    def set_speed(self, speed: float) -> None:
        """Simulated seconds per wall second; ``FASTEST`` runs as fast as it can."""

        def change(_: Dispatcher) -> None:
            self._speed = speed

        self._commands.put(change)

    def take(self) -> News | None:
        """What happened since this was asked last, and how things stand; None where nothing did.

        It is asked for, not sent: a window that is busy must not find a queue of old news.
        """
        with self._lock:
            news, self._news = self._news, None
        return news

    def _report(self, events: list[Event], status: DispatchStatus) -> None:
        with self._lock:
            before = self._news[0] if self._news else ()
            self._news = ((*before, *events), status)

    def close(self) -> None:
        """End the loop and the world; returns when both are gone.

        The world is ended from here, so that nobody waits for one that hangs or is still opening.
        """
        self._closing = True
        self._commands.put(None)
        dispatcher = self._dispatcher
        if dispatcher is not None:
            dispatcher.close()
        self.wait()

    def run(self) -> None:
        """The thread: open, tick until closed, free the world."""
        try:
            self._live()
        except StudioError as error:
            self.refused.emit(error)
        except Exception as error:
            self.broke.emit(error)

    def _live(self) -> None:
        dispatcher = self._dispatcher = self._make()
        if self._closing:
            return
        heard: list[Event] = []
        recording: Recording | None = None
        try:
            recording = Recording(heard.append, self._record())
            self._tell(recording, dispatcher.open())
            self.opened.emit(dispatcher)
            self._loop(dispatcher, recording, heard)
        except SaveError as error:
            if recording is None or not recording.told:
                raise
            recording.end("failed", str(error), dispatcher)
            phase = replace(dispatcher.status, phase="fault_hold", running=None, carrying=None)
            self._report(heard, phase)
        finally:
            dispatcher.close()
            if recording is not None:
                recording.close()

    def _loop(self, dispatcher: Dispatcher, recording: Recording, heard: list[Event]) -> None:
        """Tick until closed. ``heard`` are the events that the window was not told of yet."""
        opened = dispatcher.opened
        # Sensors elsewhere speak in wall time, and have to be waited for.
        most = 1.0 if opened is not None and opened.remote is not None else math.inf
        pace = _Pace(dispatcher.time, min(self._speed, most))
        reported, slowest, told = -math.inf, 0.0, None
        while not self._closing:
            paused = dispatcher.phase == "paused" and not self._says(dispatcher)
            still = dispatcher.finished or paused
            new = dispatcher.status is not told if still else monotonic() - reported >= FRAME
            if new:
                self.latency, slowest, told = slowest, 0.0, dispatcher.status
                self._report(heard, told)
                heard.clear()
                reported = monotonic()
            obeyed = self._obey(dispatcher, _patience(dispatcher, pace))
            if still and not obeyed:
                # Nothing asks the world anything now, and its process may end all the same.
                recording.tell(self._heeded(dispatcher.watch()))
                continue
            if obeyed or pace.speed != min(self._speed, most):
                pace = _Pace(dispatcher.time, min(self._speed, most))
            if not self._closing and pace.ahead(dispatcher.time) <= 0:
                began = monotonic()
                if self._acting is not None:
                    self._acting.before(dispatcher)
                self._tell(recording, self._heeded(dispatcher.tick()))
                slowest = max(slowest, monotonic() - began)
        if not isinstance(recording.last, RunFinished):
            recording.end("stopped", CLOSED, dispatcher)

    def _tell(self, recording: Recording, events: tuple[Event, ...]) -> None:
        recording.tell(events)
        if self._acting is not None:
            self._acting.hear(events)

    def _says(self, dispatcher: Dispatcher) -> bool:
        """Whether a script has something to say to a run that nobody else lets go on."""
        return self._acting is not None and self._acting.has_something(dispatcher)

    def _heeded(self, events: tuple[Event, ...]) -> tuple[Event, ...]:
        """What a tick told. Whoever closes a run ends its world, which is no failure of it."""
        last = events[-1] if events else None
        failed = isinstance(last, RunFinished) and last.reason == "failed"
        return events[:-2] if failed and self._closing else events

    def _obey(self, dispatcher: Dispatcher, wait: float | None) -> bool:
        """Carry out what was commanded; ``wait`` seconds for the first (None: until one comes)."""
        obeyed = False
        while not self._closing:
            try:
                command = self._commands.get(block=wait != 0, timeout=wait or None)
            except queue.Empty:
                return obeyed
            if command is not None:
                command(dispatcher)
                obeyed = True
            wait = 0.0
        return obeyed


def _patience(dispatcher: Dispatcher, pace: _Pace) -> float | None:
    """Wall seconds to wait for a command; None: until one comes."""
    if dispatcher.finished:
        return None
    return WATCH if dispatcher.phase == "paused" else pace.ahead(dispatcher.time)


class _Pace:
    """How far simulated time is ahead of the wall; a run that lags far behind lets go of it."""

    def __init__(self, start: float, speed: float) -> None:
        self.speed = speed
        self._start, self._begun = start, monotonic()

    def ahead(self, time: float) -> float:
        """Wall seconds to wait before the next tick, a frame at most; 0 to tick at once."""
        early = (time - self._start) / self.speed - (monotonic() - self._begun)
        if early < -LAG:
            self._start, self._begun = time, monotonic()
        return min(max(early, 0.0), FRAME / 2)
