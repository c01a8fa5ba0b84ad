"""Switches Python's garbage collector off while very many lasting objects are made.

While a large file is read, the collector searches all objects again and again, and finds nothing.
Without it, reading a megabyte of YAML takes two thirds of the time.
"""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager
from threading import Lock


class _Collector:
    """Counts how many blocks need the collector switched off."""

    def __init__(self) -> None:
        self._lock = Lock()
        self._waiting = 0

    def leave(self) -> bool:
        """Switch the collector off. False if somebody else had switched it off."""
        with self._lock:
            if not self._waiting and not gc.isenabled():
                return False
            self._waiting += 1
            gc.disable()
            return True

    def come_back(self) -> None:
        """Switch it on again, if no other block needs it off."""
        with self._lock:
            self._waiting -= 1
            if not self._waiting:
                gc.enable()


_COLLECTOR = _Collector()


@contextmanager
def uncollected() -> Iterator[None]:
    """Switch the collector off for a block. Threads may use it at the same time, and blocks may be
    nested.

    If the collector was off before, it stays off.
    """
    switched = _COLLECTOR.leave()
    try:
        yield
    finally:
        if switched:
            _COLLECTOR.come_back()
