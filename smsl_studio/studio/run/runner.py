"""The loop of a run in the window: it owns the dispatcher, paces it, and hands on what happened.

The dispatcher lives in this thread and its world in a child process, so that neither can hold up
the window. Wall time only paces: it decides when a tick is taken, never what the tick does.
"""

from __future__ import annotations

import math
import queue
from collections.abc import Callable
from time import monotonic

from PySide6.QtCore import QObject, QThread, Signal

from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.errors import StudioError

FRAME = 1 / 30
"""Wall seconds between two reports to the window."""

LAG = 0.25
"""Wall seconds a run may fall behind its pace before it stops trying to catch up."""
FASTEST = 1e6
"""Stands for "as fast as it can", in simulated seconds per wall second."""

Command = Callable[[Dispatcher], None]


class Runner(QThread):
    """Runs one dispatcher until it is closed. Commands may be given from the window's thread."""

    opened = Signal(object)
    """The dispatcher, once its world stands (read ``host.poses`` and ``opened`` from it only)."""
    told = Signal(object, object)
    """(events, status): what happened since the last report, and how things stand now."""
    refused = Signal(object)
    """A StudioError: the run could not be opened."""

    def __init__(
        self, make: Callable[[], Dispatcher], speed: float, parent: QObject | None = None
    ) -> None:
        super().__init__(parent)
        self._make = make
        self._speed = speed
        self._commands: queue.SimpleQueue[Command | None] = queue.SimpleQueue()
        self._closing = False

    def command(self, command: Command) -> None:
        """Have the loop call ``command`` before its next tick."""
        self._commands.put(command)

    def set_speed(self, speed: float) -> None:
        """Simulated seconds per wall second; ``FASTEST`` runs as fast as it can."""

        def change(_: Dispatcher) -> None:
            self._speed = speed

        self._commands.put(change)

    def close(self) -> None:
        """End the loop and the world; returns when both are gone."""
        self._closing = True
        self._commands.put(None)
        self.wait()

    def run(self) -> None:
        try:
            dispatcher = self._make()
        except StudioError as error:
            self.refused.emit(error)
            return
        try:
            self._loop(dispatcher)
        finally:
            dispatcher.close()

    def _loop(self, dispatcher: Dispatcher) -> None:
        events = list(dispatcher.open())
        self.opened.emit(dispatcher)
        start, begun, reported = dispatcher.status.time, monotonic(), -math.inf
        speed = self._speed
        while not self._closing:
            moving = dispatcher.status.phase not in ("finished", "paused")
            if not moving or monotonic() - reported >= FRAME:
                self.told.emit(tuple(events), dispatcher.status)
                events, reported = [], monotonic()
            commanded = self._obey(dispatcher, wait=None if not moving else 0.0)
            due = start + (monotonic() - begun) * speed
            late = due - dispatcher.status.time > LAG * speed
            if commanded or late or speed != self._speed or not moving:
                start, begun, speed = dispatcher.status.time, monotonic(), self._speed
                due = start
            if dispatcher.status.phase == "finished":
                continue
            if dispatcher.status.time <= due:
                events += dispatcher.tick()
            else:
                self._obey(dispatcher, wait=min(FRAME / 2, (dispatcher.status.time - due) / speed))

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
