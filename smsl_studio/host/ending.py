"""How a child process fares: how it ended, in words, and what time the machine gave it."""

from __future__ import annotations

import os
import signal
from pathlib import Path


def exit_code(pid: int) -> int | None:
    """How a child ended that nobody has waited for yet: its exit status, or the number of the
    signal as a negative one; None where it lives. It stays there to be waited for."""
    found = os.waitid(os.P_PID, pid, os.WEXITED | os.WNOWAIT | os.WNOHANG)
    if found is None:
        return None
    return found.si_status if found.si_code == os.CLD_EXITED else -found.si_status


def waited_for_processor(pid: int) -> float:
    """Seconds in which the main thread of a process could have worked, and all processors had
    other work; 0 where the kernel does not tell or the process is gone."""
    try:
        return int(Path(f"/proc/{pid}/schedstat").read_text("ascii").split()[1]) / 1e9
    except (OSError, ValueError, IndexError):
        return 0.0


def ending_words(code: int | None) -> str:
    """``was killed by signal 11 (SIGSEGV)`` or ``ended by itself with exit status 3``."""
    if code is not None and code < 0:
        return f"was killed by signal {-code} ({_signal_name(-code)})"
    return f"ended by itself with exit status {code}"


def _signal_name(number: int) -> str:
    try:
        return signal.Signals(number).name
    except ValueError:
        return "unknown"
