"""The loop of a run in the window: it owns the dispatcher, paces it, and hands on what happened.

The dispatcher lives in this thread and its world in a child process, so that neither can hold up
the window. Wall time only paces: it decides when a tick is taken, never what the tick does.
"""

from __future__ import annotations

import math
import threading
from collections.abc import Callable
from dataclasses import replace
from time import monotonic

from PySide6.QtCore import QObject, QThread, Signal

from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.dispatch.execution.status import DispatchStatus
from smsl_studio.dispatch.status_now import look_at_nothing
from smsl_studio.dispatch.supervision.row import Command
from smsl_studio.errors import SaveError, StudioError
from smsl_studio.front.recorder import Recorder
from smsl_studio.front.script.player import ScriptPlayer
from smsl_studio.runlog.ends import LET_GO
from smsl_studio.runlog.events import Event, RunFinished
from smsl_studio.runlog.log import RunLog
from smsl_studio.stop import Stopped, heed, heeding, is_restartable
from smsl_studio.studio.running.inbox import Inbox

FRAME = 1 / 30
"""Wall seconds between two reports to the window."""
WATCH = 0.05
"""Wall seconds between two looks at the world's process while a run stands still."""
LAG = 0.25
"""Wall seconds a run may fall behind its pace before it stops trying to catch up."""
FASTEST = 1e6
"""Stands for "as fast as it can", in simulated seconds per wall second."""
LOOK, LONGEST_LOOK = 0.01, 1.0
"""Wall seconds in which routes are looked for that are only shown; of a run that stands still it is
twice as long each time, up to the longest."""

News = tuple[tuple[Event, ...], DispatchStatus]


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
        acting: ScriptPlayer | None = None,
    ) -> None:
        super().__init__(parent)
        self._make, self._record, self._acting = make, record, acting
        self._speed = speed
        self._inbox = Inbox()
        self._look = LOOK
        self._dispatcher: Dispatcher | None = None
        self._lock = threading.Lock()
        self._news: News | None = None
        self.latency = 0.0
        """Wall seconds the slowest of the newest ticks took, from command to answer."""

    def command(self, command: Command) -> None:
        """Have the run obey before its next tick.

        What the run is at is called off for it: its planning for any command, all else for a stop.
        """
        self._inbox.say(command)

    def set_speed(self, speed: float) -> None:
        """Simulated seconds per wall second; ``FASTEST`` runs as fast as it can."""

        def change(_: Dispatcher) -> None:
            """Take the speed in the run's own thread."""
            self._speed = speed

        self._inbox.put(change)

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
        self._inbox.close()
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
        heard: list[Event] = []
        recording = Recorder(heard.append)
        try:
            with heeding(self._inbox.heed_opening):
                dispatcher = self._dispatcher = self._make()
                heed()
                recording.log = self._record()
                self._tell(recording, self._heeded(dispatcher.open()))
            self.opened.emit(dispatcher)
            self._loop(dispatcher, recording, heard)
        except Stopped:
            recording.stop(self._dispatcher)
            self._report(heard, self._stopped(recording.last))
        except SaveError as error:
            if self._dispatcher is None or not recording.told:
                raise
            recording.end("failed", str(error), self._dispatcher)
            status = self._dispatcher.status
            self._report(heard, replace(status, phase="fault_hold", running=None, carrying=None))
        finally:
            if self._dispatcher is not None:
                self._dispatcher.close()
            recording.close()

    def _stopped(self, last: Event | None) -> DispatchStatus:
        """How a run stands that was stopped before its world did."""
        assert isinstance(last, RunFinished)
        return look_at_nothing("stopped", (), last)

    def _loop(self, dispatcher: Dispatcher, recording: Recorder, heard: list[Event]) -> None:
        """Tick until closed. ``heard`` are the events that the window was not told of yet."""
        opened = dispatcher.opened
        # Sensors elsewhere speak in wall time, and have to be waited for.
        most = 1.0 if opened is not None and opened.remote is not None else math.inf
        pace = _Pace(dispatcher.time, min(self._speed, most))
        reported, slowest, told = -math.inf, 0.0, None
        while not self._inbox.closed:
            paused = dispatcher.phase == "paused" and not self._says(dispatcher)
            still = dispatcher.finished or paused
            if still or monotonic() - reported >= FRAME:
                status = self._seen(dispatcher, still)
                if status is not told:
                    self.latency, slowest, told = slowest, 0.0, status
                    self._report(heard, told)
                    heard.clear()
                reported = monotonic()
            obeyed = self._inbox.obey(dispatcher, _patience(dispatcher, pace))
            if still and not obeyed:
                # Nothing asks the world anything now, and its process may end all the same.
                recording.tell(self._heeded(dispatcher.watch()))
                continue
            if obeyed or pace.speed != min(self._speed, most):
                pace = _Pace(dispatcher.time, min(self._speed, most))
            if not self._inbox.closed and pace.ahead(dispatcher.time) <= 0:
                began = monotonic()
                if self._acting is not None:
                    self._acting.before(dispatcher)
                self._tell(recording, self._heeded(self._ticked(dispatcher, told)))
                slowest = max(slowest, monotonic() - began)
        if not isinstance(recording.last, RunFinished):
            recording.end("stopped", LET_GO, dispatcher)

    def _seen(self, dispatcher: Dispatcher, still: bool) -> DispatchStatus:
        """How the run stands, as far as it is known in the time there is to look."""
        self._inbox.until = monotonic() + self._look
        with heeding(lambda: self._inbox.heed(dispatcher)):
            status = dispatcher.status
        self._inbox.until = math.inf
        longer = status.planning and still
        self._look = min(2 * self._look, LONGEST_LOOK) if longer else LOOK
        return status

    def _ticked(self, dispatcher: Dispatcher, told: DispatchStatus | None) -> tuple[Event, ...]:
        """One tick; while it plans for long, the window is told so."""
        late = monotonic() + FRAME

        def listen() -> None:
            """Take commands while a long search goes on, and tell that it takes its time."""
            nonlocal told
            self._inbox.heed(dispatcher)
            if told is not None and not told.planning and is_restartable() and monotonic() > late:
                told = replace(told, planning=True)
                self._report([], told)

        with heeding(listen):
            return dispatcher.tick()

    def _tell(self, recording: Recorder, events: tuple[Event, ...]) -> None:
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
        return events[:-2] if failed and self._inbox.closed else events


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
