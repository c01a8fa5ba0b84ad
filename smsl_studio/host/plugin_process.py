"""The process that loads one plugin, seen from its parent: its description and its end."""

from __future__ import annotations

import contextlib
import os
import signal
import struct
import time
from collections.abc import Set
from typing import NamedTuple

from smsl_studio.host.description import LARGEST
from smsl_studio.host.exit_words import ending_words, exit_code
from smsl_studio.host.patience import Patience
from smsl_studio.host.processor import ProcessorTime

PATIENCE = 2.0
"""The time (s) that a process may take to end after it has closed its pipe."""

LOOK = 0.05
"""The wall time (s) from one look at the processor time of the process to the next."""

SIZE = struct.Struct("!I")
"""The number of bytes of a description, which stands before it on the pipe."""


class PluginAnswer(NamedTuple):
    """The bytes of a plugin's description, or None and the reason in words."""

    body: bytes | None
    words: str = ""


class PluginProcess:
    """A process that loads a plugin, for at most ``limit`` seconds.

    Time in which the machine gives it next to no processor time does not count (see ``Patience``).
    The first ``turn`` seconds are its turn: in this time it counts among the processes that load
    together.
    """

    def __init__(self, number: int, pid: int, pipe: int, limit: float, turn: float) -> None:
        now = time.monotonic()
        self.number = number
        self.pid = pid
        self._pipe = pipe
        self._gone = os.pidfd_open(pid)
        self._come = bytearray()
        self._limit = limit
        self._wait = Patience(limit)
        self._given = ProcessorTime.of(pid)
        self._turn = now + turn
        self._closed = False

    @property
    def files(self) -> tuple[int, ...]:
        """The files to poll: the pipe of its description, and the file that shows its end."""
        return (self._gone,) if self._closed else (self._pipe, self._gone)

    def has_turn(self, now: float) -> bool:
        """Whether its turn still lasts at the monotonic time ``now`` (s)."""
        return now < self._turn

    def due(self, now: float) -> float:
        """Return the monotonic time (s) at which to call ``told`` at the latest."""
        look = now + LOOK
        return min(self._turn, look) if self.has_turn(now) else look

    def told(self, ready: Set[int]) -> PluginAnswer | None:
        """Read from the files that are ``ready``. Return the answer, or None if it is not yet
        complete."""
        if self._pipe in ready:
            piece = os.read(self._pipe, 2**16)
            self._come += piece
            if piece and (told := self._whole()) is not None:
                return told
            if not piece:
                self._let_go()
        elif self._gone in ready and not self._closed:
            self._let_go()  # its own children may hold the pipe open for ever
        if self._closed and self._gone in ready:
            return PluginAnswer(
                None, f"the process that loaded it {ending_words(exit_code(self.pid))}"
            )
        self._look()
        if not self._wait.over:
            return None
        if self._closed:
            return PluginAnswer(None, "it closed the pipe on which it is described")
        return PluginAnswer(None, f"it did not load within {self._limit:g} s")

    def _whole(self) -> PluginAnswer | None:
        if len(self._come) < SIZE.size:
            return None
        (size,) = SIZE.unpack_from(self._come)
        if size > LARGEST:
            return PluginAnswer(None, f"its description has {size} bytes, more than {LARGEST}")
        whole = bytes(self._come[SIZE.size : SIZE.size + size])
        return PluginAnswer(whole) if len(whole) == size else None

    def _look(self) -> None:
        """Count the time since the last look, unless it is too short to tell whether it worked."""
        if time.monotonic() - self._given.at < LOOK:
            return
        before, self._given = self._given, ProcessorTime.of(self.pid)
        self._wait.look(shut_out=self._given.shut_out_since(before))

    def _let_go(self) -> None:
        self._closed = True
        self._wait = Patience(PATIENCE)

    def kill(self) -> None:
        """Kill the process and its process group, without waiting for their end."""
        for end in (os.killpg, os.kill):
            with contextlib.suppress(OSError):
                end(self.pid, signal.SIGKILL)

    def end(self) -> None:
        """Kill the process and its process group, and wait for the end of the process."""
        self.kill()
        os.waitpid(self.pid, 0)
        self.close()

    def close(self) -> None:
        """Close its files. A forked copy of the parent does only this."""
        os.close(self._pipe)
        os.close(self._gone)
