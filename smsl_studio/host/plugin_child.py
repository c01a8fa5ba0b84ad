"""The child that loads plugins to describe them, each plugin in a process of its own.

The child is a fresh interpreter. It runs no code of a plugin itself, and forks once for every
plugin. So a plugin's changes to its process (patches, threads, closed files, an exit) do not affect
other plugins. Several plugins load at the same time if the system keeps their processes from
signalling each other.
"""

from __future__ import annotations

import contextlib
import os
import select
import socket
import time
from collections import deque
from collections.abc import Sequence
from importlib import import_module
from typing import NoReturn

from smsl_studio.host.bounds import limit_process, settle_in
from smsl_studio.host.brief import words_for
from smsl_studio.host.codec import Unfit, opaque
from smsl_studio.host.compound import optional, row
from smsl_studio.host.confinement import confine, end_with
from smsl_studio.host.description import LARGEST, written
from smsl_studio.host.plugin_process import SIZE, PluginAnswer, PluginProcess
from smsl_studio.host.vocabulary import COUNT, sentence
from smsl_studio.host.wire import ChildWire
from smsl_studio.library.loaded import PluginFault
from smsl_studio.library.loading import load_from_bytes
from smsl_studio.library.survey import FoundPlugin

STEP = row(COUNT, COUNT, optional(opaque(LARGEST)), sentence())
"""The number of a plugin and the number of its process. The message at the end adds the description
or the reason of the failure."""

TURN = 1.0
"""The time (s) after which the next plugin starts beside a plugin that is still loading."""


def main(pipe: int, beat: int) -> None:
    """Load the plugins in their processes, and send their descriptions to the parent.

    ``pipe`` and ``beat`` are file numbers; no heartbeat is written.
    """
    settle_in()
    os.close(beat)
    wire = ChildWire(socket.socket(fileno=pipe))
    with contextlib.suppress(EOFError, OSError):  # the parent is gone
        _, (found, limit, together) = wire.receive()
        if len(found) > 1:
            _import_for_all()
        _Loads(wire, found, limit, together).carry_on()
        wire.send("ok", b"")
    os._exit(0)


def _import_for_all() -> None:
    """Import what most worlds import, so that not each process of a plugin does it again.

    Of this, NumPy takes 0.1 s of a processor. A plugin that uses something else loads as before.
    """
    with contextlib.suppress(ImportError):
        for name in ("grasps", "arms.panda", "meshes"):
            import_module(f"smsl_studio.world.{name}")


class _Loads:
    """The processes that load plugins, each for at most ``limit`` seconds.

    At most ``together`` processes have a turn at the same time. A process whose turn is over goes
    on beside them, so plugins that hang do not delay the others. All processes have begun after
    half of ``limit``. If ``together`` is 0, only one process runs at a time.
    """

    def __init__(
        self, wire: ChildWire, found: Sequence[FoundPlugin], limit: float, together: int
    ) -> None:
        self._wire = wire
        self._limit = limit
        self._together = together
        self._me, self._program = os.getpid(), os.getppid()
        self._waiting = deque(enumerate(found))
        self._running: list[PluginProcess] = []
        self._half = time.monotonic() + limit / 2

    def carry_on(self) -> None:
        """Load all plugins. Send one message when a plugin begins, and one when it is done.

        EOFError if the parent is gone.
        """
        try:
            while self._waiting or self._running:
                now = time.monotonic()
                while self._waiting and self._has_room(now):
                    self._begin(*self._waiting.popleft())
                ready = self._ready(now)
                for one in list(self._running):
                    if (told := one.told(ready)) is not None:
                        self._running.remove(one)
                        one.end()
                        self._tell(one, told)
        finally:
            for one in self._running:
                one.kill()
            for one in self._running:
                one.end()

    def _has_room(self, now: float) -> bool:
        at_turn = sum(one.has_turn(now) for one in self._running)
        return at_turn < self._together if self._together else not self._running

    def _begin(self, number: int, found: FoundPlugin) -> None:
        told, tell = os.pipe()
        pid = os.fork()
        if pid == 0:
            os.close(told)
            for other in self._running:
                other.close()
            _tell_of(found, self._wire, tell, (self._me, self._program))
        os.close(tell)
        with contextlib.suppress(OSError):
            os.setpgid(pid, pid)
        one = PluginProcess(number, pid, told, self._limit, self._turn())
        self._running.append(one)
        self._tell(one, PluginAnswer(None))

    def _turn(self) -> float:
        """Return the length (s) of the turn of the next process."""
        if not self._together:
            return self._limit
        left = max(0.0, self._half - time.monotonic())
        return min(TURN, left * self._together / (len(self._waiting) + 1))

    def _tell(self, one: PluginProcess, told: PluginAnswer) -> None:
        self._wire.send("loads", STEP.encode((one.number, one.pid, told.body, told.words)))

    def _ready(self, now: float) -> set[int]:
        """Wait for files that can be read, or for the end of a process, and return these files.

        The set is empty if a turn ends first, or it is time for the next look at the processes.
        EOFError if the parent is gone.
        """
        look = select.poll()
        look.register(self._wire.fileno(), 0)
        for one in self._running:
            for file in one.files:
                look.register(file, select.POLLIN)
        due = min(one.due(now) for one in self._running)
        ready = {file for file, _ in look.poll(max(0.0, due - time.monotonic()) * 1000)}
        if self._wire.fileno() in ready:
            raise EOFError
        return ready


def _tell_of(found: FoundPlugin, wire: ChildWire, pipe: int, above: tuple[int, int]) -> NoReturn:
    """Load one plugin, send its description, and end the process.

    ``above`` are the numbers of the processes above it: this child, and the program.
    """
    try:
        end_with(above[0])
        with contextlib.suppress(OSError):
            os.setpgid(0, 0)
        wire.close()
        limit_process()
        confine(*above)
        body = _described(found)
        _write(pipe, SIZE.pack(len(body)) + body)
    finally:
        os._exit(0)


def _described(found: FoundPlugin) -> bytes:
    try:
        return written(load_from_bytes(found))
    except Unfit as error:
        words = f"it cannot be described: {error}"
    except BaseException as error:  # values in the plugin's library may raise any error
        words = f"it cannot be described: {words_for(error)}"
    return written(PluginFault(found.name, words, None, found.location))


def _write(pipe: int, data: bytes) -> None:
    while data:
        data = data[os.write(pipe, data) :]
