"""Python's garbage collector, told to wait while very many objects are made that all stay.

It looks through everything that lives again and again while a large file is read, and finds
nothing: without that, reading a megabyte of YAML takes two thirds of the time.
"""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager
from threading import Lock


class _Collector:
    """How many are waiting for the collector to stay away."""

    def __init__(self) -> None:
        self._lock = Lock()
        self._waiting = 0

    def leave(self) -> bool:
        """Switch it off; False where somebody else had done so."""
        with self._lock:
            if not self._waiting and not gc.isenabled():
                return False
            self._waiting += 1
            gc.disable()
            return True

    def come_back(self) -> None:
        """Switch it on again, when this was the last that had it switched off."""
        with self._lock:
            self._waiting -= 1
            if not self._waiting:
                gc.enable()


_COLLECTOR = _Collector()


@contextmanager
def uncollected() -> Iterator[None]:
    """Switch collection off for a block; threads may use it at once, and blocks may be nested.

    Where the collector was switched off before, it stays so.
    """
    switched = _COLLECTOR.leave()
    try:
        yield
    finally:
        if switched:
            _COLLECTOR.come_back()
