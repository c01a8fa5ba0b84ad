"""How a child process ended, in words."""

from __future__ import annotations

import signal


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
