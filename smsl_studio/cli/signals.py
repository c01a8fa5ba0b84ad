"""Ctrl-C, SIGTERM and SIGHUP on the command line stop the running command (see ``stop``).

The first signal counts; later ones change nothing, so that what has to be closed is closed. Where a
library has swallowed the exception it is raised again.
"""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.machinery import ExtensionFileLoader
from types import FrameType

from smsl_studio.stop import GRACE, BrokenOff, Stopped, heeding, is_graceful, is_whole

AGAIN = 1.0
"""Wall seconds after which a stop that nobody has taken is raised once more."""

SOON = 0.002
"""Wall seconds after which it is raised again where a library in C was being loaded."""

NUMBERS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


class Signals:
    """What was signalled to this command: ``asked`` is the number of the signal, 0 for none."""

    def __init__(self) -> None:
        self.asked = 0
        self._taken = self._over = False

    @property
    def status(self) -> int:
        """The exit status of a command that was called off: 128 and the signal, as in shells."""
        return 128 + (self.asked or signal.SIGINT)

    def is_asked(self) -> bool:
        """Whether the command is to stop."""
        return bool(self.asked)

    def take(self) -> None:
        """Note that the stop is carried out: from now on only work that does not end is broken
        off."""
        self._taken = True
        if self.asked:
            signal.setitimer(signal.ITIMER_REAL, AGAIN, AGAIN)

    def close(self) -> None:
        """Note that the command is over: no signal stops it any more."""
        self._taken = self._over = True
        if self.asked:
            signal.setitimer(signal.ITIMER_REAL, 0.0)

    def heed(self) -> None:
        """Raise Stopped where the command is to stop."""
        if self.asked and not self._taken:
            raise Stopped

    def hear(self, number: int, frame: FrameType | None) -> None:
        """The handler of the signals."""
        if self.asked or self._over:
            return
        self.asked = number
        graceful = is_graceful()
        signal.setitimer(signal.ITIMER_REAL, GRACE if graceful else AGAIN, AGAIN)
        if not graceful:
            self.insist(number, frame)

    def insist(self, number: int, frame: FrameType | None) -> None:
        """Break off the work, unless it must be whole; such work checks for a stop at its end."""
        if not self.asked or self._over or is_whole():
            return
        if _loads_a_library(frame):
            signal.setitimer(signal.ITIMER_REAL, SOON, AGAIN)
            return
        raise BrokenOff


def _loads_a_library(frame: FrameType | None) -> bool:
    """Whether a library in C is being loaded: some of them crash where an exception comes then.

    While one is loaded it may import modules in Python, in which the signal is heard.
    """
    while frame is not None:
        if frame.f_code.co_name in ("exec_module", "create_module") and isinstance(
            frame.f_locals.get("self"), ExtensionFileLoader
        ):
            return True
        frame = frame.f_back
    return False


@contextmanager
def heard() -> Iterator[Signals]:
    """Hear the signals while a command runs; in the main thread only, as Python has it."""
    signals = Signals()
    if threading.current_thread() is not threading.main_thread():
        yield signals
        return
    # Under nohup the end of the terminal is to be ignored, and stays so.
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
