"""The commands that wait for a run, and what they interrupt in its thread."""

from __future__ import annotations

import queue
from collections.abc import Callable
from time import monotonic

from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.dispatch.supervision.row import Command
from smsl_studio.stop import Stopped, is_restartable

Call = Callable[[Dispatcher], None]
"""A call that the thread of a run makes with its dispatcher before the next tick."""


class Inbox:
    """The commands for one run, in the order of arrival.

    Any thread may put a command; the run's thread obeys. ``closed`` says that the window ends the
    run. ``stopped`` says that a stop was sent. ``called_off`` is set when something is
    interrupted.
    """

    def __init__(self) -> None:
        self.closed = self.stopped = self.called_off = False
        self.until = float("inf")
        """The time (``time.monotonic``) at which computing the status must end."""
        self._calls: queue.SimpleQueue[Call | None] = queue.SimpleQueue()
        self._obeyed = False

    def put(self, call: Call) -> None:
        """Queue a call for the time before the run's next tick."""
        self._calls.put(call)

    def say(self, command: Command) -> None:
        """Queue a command for the time before the run's next tick."""
        self.stopped = self.stopped or command.word == "stop"
        self._calls.put(lambda dispatcher: dispatcher.take(command))

    def close(self) -> None:
        """End the run; a thread that waits for a command wakes up."""
        self.closed = True
        self._calls.put(None)

    def obey(self, dispatcher: Dispatcher, wait: float | None) -> bool:
        """Hand the queued commands to the dispatcher; returns whether there were any.

        It waits up to ``wait`` seconds for the first one. None waits without a limit.
        """
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
        """Raise ``Stopped`` if the run was closed or stopped before it began."""
        if self.closed or self.stopped:
            raise Stopped

    def heed(self, dispatcher: Dispatcher) -> None:
        """Take new commands, and raise ``Stopped`` to interrupt what the run is doing.

        A stop interrupts everything. Any other command, or the time ``until``, interrupts only work
        that can be started again.
        """
        if self.closed:
            self.called_off = True
            raise Stopped
        while not self._calls.empty():
            call = self._calls.get()
            if call is not None:
                call(dispatcher)
                self._obeyed = True
        said = [command.word for command in dispatcher.waiting]
        if "stop" in said or (is_restartable() and (said or monotonic() > self.until)):
            self.called_off = True
            raise Stopped
