"""Ctrl-C, SIGTERM and SIGHUP on the command line stop the running command (see ``stop``).

Only the first signal counts, so that later signals do not interrupt the closing of files. If a
library catches the exception and goes on, the exception is raised again.
"""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.machinery import ExtensionFileLoader
from types import FrameType

from smsl_studio.stop import (
    GRACE,
    BrokenOff,
    Stopped,
    heeding,
    is_graceful,
    is_whole,
    spare_the_old,
)

AGAIN = 1.0
"""The wall time (s) after which a stop without effect is raised again."""

SOON = 0.002
"""The wall time (s) after which a stop is raised again if a library in C was being loaded."""

NUMBERS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


class Signals:
    """The signals to this command. ``asked`` is the number of the first signal, or 0."""

    def __init__(self) -> None:
        self.asked = 0
        self._taken = self._over = False

    @property
    def status(self) -> int:
        """The exit status of a stopped command: 128 + the number of the signal, as in shells."""
        return 128 + (self.asked or signal.SIGINT)

    def is_asked(self) -> bool:
        """Whether the command must stop."""
        return bool(self.asked)

    def take(self) -> None:
        """Note that the command carries out the stop. From now on only work that does not end is
        broken off."""
        self._taken = True
        if self.asked:
            signal.setitimer(signal.ITIMER_REAL, AGAIN, AGAIN)

    def close(self) -> None:
        """Note that the command is over. Later signals have no effect."""
        self._taken = self._over = True
        if self.asked:
            signal.setitimer(signal.ITIMER_REAL, 0.0)

    def heed(self) -> None:
        """Raise Stopped if the command must stop."""
        if self.asked and not self._taken:
            raise Stopped

    def hear(self, number: int, frame: FrameType | None) -> None:
        """Handle a signal."""
        if self.asked or self._over:
            return
        self.asked = number
        graceful = is_graceful()
        signal.setitimer(signal.ITIMER_REAL, GRACE if graceful else AGAIN, AGAIN)
        if not graceful:
            self.insist(number, frame)

    def insist(self, number: int, frame: FrameType | None) -> None:
        """Break off the work, unless it must be whole. Such work checks for a stop at its end."""
        if not self.asked or self._over or is_whole():
            return
        if _ends_first(frame):
            signal.setitimer(signal.ITIMER_REAL, SOON, AGAIN)
            return
        raise BrokenOff


def _ends_first(frame: FrameType | None) -> bool:
    """Whether something runs that an exception must not leave.

    This is a library in C that is being loaded: some crash then, also by a signal in a Python
    module that they import. And it is what Python calls at the garbage collection: an exception in
    it is lost, but printed.
    """
    while frame is not None:
        if frame.f_code is spare_the_old.__code__:
            return True
        if frame.f_code.co_name in ("exec_module", "create_module") and isinstance(
            frame.f_locals.get("self"), ExtensionFileLoader
        ):
            return True
        frame = frame.f_back
    return False


@contextmanager
def heard() -> Iterator[Signals]:
    """Handle the signals inside the block. Python allows this only in the main thread."""
    signals = Signals()
    if threading.current_thread() is not threading.main_thread():
        yield signals
        return
    # Under nohup SIGHUP is ignored, and must stay ignored.
    deaf = signal.getsignal(signal.SIGHUP) is signal.SIG_IGN
    numbers = [number for number in NUMBERS if number != signal.SIGHUP or not deaf]
    kept = {number: signal.signal(number, signals.hear) for number in numbers}
    kept[signal.SIGALRM] = signal.signal(signal.SIGALRM, signals.insist)
    try:
        with heeding(signals.heed):
            yield signals
    finally:
        signals.close()
        for number, handler in kept.items():
            signal.signal(number, handler)
