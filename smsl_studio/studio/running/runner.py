"""The thread of a run: it owns the dispatcher, paces it, and hands over what happened.

The dispatcher lives in this thread and its world in a child process, so neither can block the
window. Wall time only paces: it decides when a tick is made, never what a tick does.
"""

from __future__ import annotations

import math
import threading
from collections.abc import Callable, Mapping
from dataclasses import replace
from time import monotonic
from typing import Any

from PySide6.QtCore import QObject, QThread, Signal

from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.dispatch.drive.generation import EdgeProposer
from smsl_studio.dispatch.execution.status import DispatchStatus
from smsl_studio.dispatch.status_now import look_at_nothing
from smsl_studio.dispatch.supervision.row import Command
from smsl_studio.errors import RunRefused, SaveError, StudioError, WorldError
from smsl_studio.front.recorder import Recorder
from smsl_studio.front.script.player import ScriptPlayer
from smsl_studio.front.script.script import Act, Script
from smsl_studio.front.script.transcript import Transcript
from smsl_studio.runlog.ends import LET_GO
from smsl_studio.runlog.events import Event, RunFinished
from smsl_studio.runlog.log import RunLog
from smsl_studio.stop import Stopped, heed, heeding, is_restartable
from smsl_studio.studio.running.inbox import Inbox
from smsl_studio.studio.running.operation_time import OperationTime, ShownTime

FRAME = 1 / 30
"""Wall seconds between two reports to the window."""
WATCH = 0.05
"""Wall seconds between two checks of the world's process while a run is paused."""
LAG = 0.25
"""Wall seconds by which a run may be late before it gives up catching up."""
FASTEST = 1e6
"""The speed that means "as fast as possible", in simulated seconds per wall second."""
LOOK, LONGEST_LOOK = 0.01, 1.0
"""Wall seconds for planning routes that are only shown.

While a run is paused the time doubles with each try, up to the longest.
"""

News = tuple[tuple[Event, ...], DispatchStatus]


def _no_log() -> None:
    """No log, for runs that are not recorded."""


class Runner(QThread):
    """Runs one dispatcher until it is closed. Other threads may send commands.

    ``make`` (returns the dispatcher) and ``record`` (starts the log) are called in this thread. If
    ``record`` raises SaveError, the run is refused. ``acting`` is a script that commands the run.
    ``time`` says for how long operations are shown that take no time of their own.
    """

    opened = Signal(object)
    """Dispatcher: its world is ready. Read only ``host.poses`` and ``opened`` of it."""
    refused = Signal(object)
    """A StudioError: the run could not be opened."""
    broke = Signal(object)
    """Exception: an unexpected error ended the run."""

    def __init__(
        self,
        make: Callable[[], Dispatcher],
        speed: float,
        parent: QObject | None = None,
        record: Callable[[], RunLog | None] = _no_log,
        acting: ScriptPlayer | None = None,
        time: OperationTime | None = None,
    ) -> None:
        super().__init__(parent)
        self._make, self._record = make, record
        self._acting = acting or ScriptPlayer(Script(), stays=True)
        self._transcript = Transcript()
        self._time = time or OperationTime(None)
        self.refusal: Callable[[StudioError], StudioError] = lambda error: error
        """Returns an error at the start as the window shows it, and the log of the run has it."""
        self._speed = speed
        self._inbox = Inbox()
        self._look = LOOK
        self._dispatcher: Dispatcher | None = None
        self._lock = threading.Lock()
        self._news: News | None = None
        self.latency = 0.0
        """The wall seconds of the slowest recent tick."""

    @property
    def shown_time(self) -> ShownTime | None:
        """The time for which the running operation is shown; None if it takes its own time."""
        return self._time.shown

    @property
    def lines(self) -> tuple[Mapping[str, Any], ...]:
        """What was commanded so far, as the lines of a script."""
        return self._transcript.lines

    @property
    def planned(self) -> tuple[Act, ...]:
        """The acts that wait for their moments."""
        return self._acting.left

    def plan(self, act: Act) -> None:
        """Have an act carried out the next time that its moment comes."""
        self._inbox.put(lambda _: self._acting.plan(act))

    def drop_plans(self) -> None:
        """Forget the acts that wait for their moments."""
        self._inbox.put(lambda _: self._acting.drop_all())

    def command(self, command: Command) -> None:
        """Send a command to the run; it takes effect before the next tick.

        It interrupts what the run is doing: any command interrupts planning, and a stop interrupts
        everything.
        """
        self._inbox.say(command)

    def propose_with(self, proposer: EdgeProposer | None) -> None:
        """Let a provider propose edges from now on, where no way leads to the goals."""
        self._inbox.put(lambda dispatcher: dispatcher.propose_with(proposer))

    def set_speed(self, speed: float) -> None:
        """Set the simulated seconds per wall second; ``FASTEST`` is as fast as possible."""

        def change(_: Dispatcher) -> None:
            """Set the speed in the run's own thread."""
            self._speed = speed

        self._inbox.put(change)

    def take(self) -> News | None:
        """The events since the last call, and the present status; None if there are no news.

        The window asks for news instead of receiving signals, so that a busy window does not
        collect a queue of old ones.
        """
        with self._lock:
            news, self._news = self._news, None
        return news

    def _report(self, events: list[Event], status: DispatchStatus) -> None:
        with self._lock:
            before = self._news[0] if self._news else ()
            self._news = ((*before, *events), status)

    def close(self) -> None:
        """End the loop and the world; returns when both have ended.

        The calling thread ends the world, so that a world that hangs or is still opening delays
        nobody.
        """
        self._inbox.close()
        dispatcher = self._dispatcher
        if dispatcher is not None:
            dispatcher.close()
        self.wait()

    def run(self) -> None:
        """The body of the thread: open, tick until closed, end the world."""
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
                events = self._heeded(dispatcher.open())
                self._tell(recording, events)
                self._transcript.hear(events)
            self.opened.emit(dispatcher)
            self._loop(dispatcher, recording, heard)
        except Stopped:
            recording.stop(self._dispatcher)
            self._report(heard, self._stopped(recording.last))
        except WorldError as error:
            if recording.told:
                raise
            refused = self.refusal(error)
            told = refused.told if isinstance(refused, RunRefused) else ()
            recording.end("refused", str(error), self._dispatcher, told)
            raise refused from None
        except SaveError as error:
            if self._dispatcher is None or not recording.told:
                raise
            recording.end("failed", str(error), self._dispatcher)
            status = self._seen(self._dispatcher, still=True)
            self._report(heard, replace(status, phase="fault_hold", running=None, carrying=None))
        finally:
            if self._dispatcher is not None:
                self._dispatcher.close()
            recording.close()

    def _stopped(self, last: Event | None) -> DispatchStatus:
        """The status of a run that was stopped before its world was ready."""
        assert isinstance(last, RunFinished)
        return look_at_nothing("stopped", (), last)

    def _loop(self, dispatcher: Dispatcher, recording: Recorder, heard: list[Event]) -> None:
        """Tick until closed. ``heard`` are the events that were not reported to the window yet."""
        opened = dispatcher.opened
        # Sensors elsewhere send in wall time, so simulated time must not be faster.
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
            left = min(self._time.left(dispatcher, min(self._speed, most)), FRAME / 2)
            obeyed = self._inbox.obey(dispatcher, left or _patience(dispatcher, pace))
            if still and not obeyed:
                # No tick asks the world now, but its process may still die.
                recording.tell(self._heeded(dispatcher.watch()))
                continue
            if obeyed or left or pace.speed != min(self._speed, most):
                pace = _Pace(dispatcher.time, min(self._speed, most))
            if self._time.left(dispatcher, min(self._speed, most)) > 0:
                continue
            if not self._inbox.closed and pace.ahead(dispatcher.time) <= 0:
                began = monotonic()
                self._tick(dispatcher, recording, told)
                slowest = max(slowest, monotonic() - began)
        if not isinstance(recording.last, RunFinished):
            # A run that a person has stopped goes on no more: it ends as they ended it.
            stopped = dispatcher.phase == "stopped"
            words = dispatcher.standing.sentence if stopped else LET_GO
            recording.end("stopped", words, dispatcher)

    def _seen(self, dispatcher: Dispatcher, still: bool) -> DispatchStatus:
        """The status, with routes as far as they can be planned in the given time."""
        self._inbox.until = monotonic() + self._look
        with heeding(lambda: self._inbox.heed(dispatcher)):
            status = dispatcher.status
        self._inbox.until = math.inf
        longer = status.planning and still
        self._look = min(2 * self._look, LONGEST_LOOK) if longer else LOOK
        return status

    def _tick(
        self, dispatcher: Dispatcher, recording: Recorder, told: DispatchStatus | None
    ) -> None:
        """Make one tick with the commands that are due, and write down what people did in it."""
        self._acting.before(dispatcher)
        self._transcript.before(dispatcher)
        self._inbox.called_off = False
        events = self._heeded(self._ticked(dispatcher, told))
        self._tell(recording, events)
        self._transcript.after(dispatcher, events, whole=not self._inbox.called_off)
        self._time.follow(dispatcher)

    def _ticked(self, dispatcher: Dispatcher, told: DispatchStatus | None) -> tuple[Event, ...]:
        """Make one tick. If it plans for long, report that to the window."""
        late = monotonic() + FRAME

        def listen() -> None:
            """Take commands during a long search, and report that it takes long."""
            nonlocal told
            self._inbox.heed(dispatcher)
            if told is not None and not told.planning and is_restartable() and monotonic() > late:
                told = replace(told, planning=True)
                self._report([], told)

        with heeding(listen):
            return dispatcher.tick()

    def _tell(self, recording: Recorder, events: tuple[Event, ...]) -> None:
        recording.tell(events)
        self._acting.hear(events)

    def _says(self, dispatcher: Dispatcher) -> bool:
        """Whether the script has a command for a run that is paused."""
        return self._acting.has_something(dispatcher)

    def _heeded(self, events: tuple[Event, ...]) -> tuple[Event, ...]:
        """The events of a tick, without the failure that closing a run causes in its world."""
        last = events[-1] if events else None
        failed = isinstance(last, RunFinished) and last.reason == "failed"
        return events[:-2] if failed and self._inbox.closed else events


def _patience(dispatcher: Dispatcher, pace: _Pace) -> float | None:
    """Wall seconds to wait for a command; None waits without a limit."""
    if dispatcher.finished:
        return None
    return WATCH if dispatcher.phase == "paused" else pace.ahead(dispatcher.time)


class _Pace:
    """Compares simulated time with wall time. A run that is very late starts to count anew."""

    def __init__(self, start: float, speed: float) -> None:
        self.speed = speed
        self._start, self._begun = start, monotonic()

    def ahead(self, time: float) -> float:
        """Wall seconds to wait before the next tick, half a frame at most; 0 to tick at once."""
        early = (time - self._start) / self.speed - (monotonic() - self._begun)
        if early < -LAG:
            self._start, self._begun = time, monotonic()
        return min(max(early, 0.0), FRAME / 2)
