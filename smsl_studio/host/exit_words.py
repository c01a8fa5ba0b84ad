"""The end of a child process: its exit code, and a sentence about it."""

from __future__ import annotations

import os
import signal


def exit_code(pid: int) -> int | None:
    """Return the exit status of a child, or the negative number of the signal that ended it.

    The result is None while the child lives. The child is not reaped: it can still be waited for.
    """
    found = os.waitid(os.P_PID, pid, os.WEXITED | os.WNOWAIT | os.WNOHANG)
    if found is None:
        return None
    return found.si_status if found.si_code == os.CLD_EXITED else -found.si_status


def ending_words(code: int | None) -> str:
    """Describe an exit code, such as ``was killed by signal 11 (SIGSEGV)`` or ``ended by itself
    with exit status 3``."""
    if code is not None and code < 0:
        return f"was killed by signal {-code} ({_signal_name(-code)})"
    return f"ended by itself with exit status {code}"


def _signal_name(number: int) -> str:
    try:
        return signal.Signals(number).name
    except ValueError:
        return "unknown"
