"""The commands that wait for a run, and what they call off in its thread."""

from __future__ import annotations

import queue
from collections.abc import Callable
from time import monotonic

from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.dispatch.supervision.row import Command
from smsl_studio.stop import Stopped, is_restartable

Call = Callable[[Dispatcher], None]
"""What the thread of a run does with its dispatcher before the next tick."""


class Inbox:
    """Commands of one run, in the order they came. Any thread may put; the run's thread obeys.

    ``closed`` says that the window lets go of the run, ``stopped`` that a stop has come.
    """

    def __init__(self) -> None:
        self.closed = self.stopped = False
        self.until = float("inf")
        """When (``time.monotonic``) a look at the run has taken long enough."""
        self._calls: queue.SimpleQueue[Call | None] = queue.SimpleQueue()
        self._obeyed = False

    def put(self, call: Call) -> None:
        """Have the run do something before its next tick."""
        self._calls.put(call)

    def say(self, command: Command) -> None:
        """Have the run obey before its next tick."""
        self.stopped = self.stopped or command.word == "stop"
        self._calls.put(lambda dispatcher: dispatcher.take(command))

    def close(self) -> None:
        """Have the run end; whoever waits for a command wakes up."""
        self.closed = True
        self._calls.put(None)

    def obey(self, dispatcher: Dispatcher, wait: float | None) -> bool:
        """Give the dispatcher what was commanded since the last time, and say whether that was
        anything; ``wait`` seconds for the first (None: until one comes)."""
        while not self.closed and not (self._obeyed and wait):
            try:
                call = self._calls.get(block=wait != 0, timeout=wait or None)
            except queue.Empty:
                break
            if call is not None:
                call(dispatcher)
                self._obeyed = True
            wait = 0.0
        obeyed, self._obeyed = self._obeyed, False
        return obeyed

    def heed_opening(self) -> None:
        """Call off the opening of a run that is let go of, or stopped before it began."""
        if self.closed or self.stopped:
            raise Stopped

    def heed(self, dispatcher: Dispatcher) -> None:
        """Call off what a run is at: for a stop whatever it is, for any command and for a look
        that has lasted long enough what can be asked again."""
        if self.closed:
            raise Stopped
        while not self._calls.empty():
            call = self._calls.get()
            if call is not None:
                call(dispatcher)
                self._obeyed = True
        said = dispatcher.commanded
        if "stop" in said or (is_restartable() and (said or monotonic() > self.until)):
            raise Stopped
