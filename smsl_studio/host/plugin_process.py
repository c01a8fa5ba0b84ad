"""The process that loads one plugin, as who started it sees it: what it tells, and its end."""

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

PATIENCE = 2.0
"""Seconds that a process may take to end after it has let go of its pipe."""

SIZE = struct.Struct("!I")
"""How a description begins on the pipe: with the number of its bytes."""


class PluginAnswer(NamedTuple):
    """A plugin's description, or why there is none."""

    body: bytes | None
    words: str = ""


class PluginProcess:
    """A running process: for ``limit`` seconds at most; the first ``turn`` seconds are its turn."""

    def __init__(self, number: int, pid: int, pipe: int, limit: float, turn: float) -> None:
        now = time.monotonic()
        self.number = number
        self.pid = pid
        self._pipe = pipe
        self._gone = os.pidfd_open(pid)
        self._come = bytearray()
        self._limit = limit
        self._until = now + limit
        self._turn = now + turn
        self._closed = False

    @property
    def files(self) -> tuple[int, ...]:
        """What is waited for: what it tells, and its end."""
        return (self._gone,) if self._closed else (self._pipe, self._gone)

    def has_turn(self, now: float) -> bool:
        """Whether its turn lasts at this moment."""
        return now < self._turn

    def due(self, now: float) -> float:
        """When it must be looked at, whatever is told: the end of its turn, or of its time."""
        return min(self._turn, self._until) if self.has_turn(now) else self._until

    def told(self, ready: Set[int]) -> PluginAnswer | None:
        """What it has told, with the files that are ready; None while that is not whole."""
        if self._pipe in ready:
            piece = os.read(self._pipe, 2**16)
            self._come += piece
            if piece and (told := self._whole()) is not None:
                return told
            if not piece:
                self._let_go()
        elif self._gone in ready and not self._closed:
            self._let_go()  # what it has started may hold the pipe for ever
        if self._closed and self._gone in ready:
            return PluginAnswer(
                None, f"the process that loaded it {ending_words(exit_code(self.pid))}"
            )
        if time.monotonic() < self._until:
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

    def _let_go(self) -> None:
        self._closed = True
        self._until = time.monotonic() + PATIENCE

    def kill(self) -> None:
        """Tell it, and all that it started, to end; it does not wait for that."""
        for end in (os.killpg, os.kill):
            with contextlib.suppress(OSError):
                end(self.pid, signal.SIGKILL)

    def end(self) -> None:
        """End it and all that it started."""
        self.kill()
        os.waitpid(self.pid, 0)
        self.close()

    def close(self) -> None:
        """Let go of its files alone, in a copy of the process that started it."""
        os.close(self._pipe)
        os.close(self._gone)
