"""Collects garbage in the thread of the windows, and nowhere else.

Python's collector runs in the thread that happens to make the next object. If it frees a widget in
the thread of a run or of a worker, Qt crashes. So it is switched off for the whole program, and a
timer of the windows collects instead.
"""

from __future__ import annotations

import gc
from time import monotonic

from PySide6.QtCore import QObject, QTimer

PAUSE = 100
"""Milliseconds between two looks at how much was made."""
YOUNG = 10_000
"""The number of new objects that are worth a collection."""
ROUNDS = 10
"""The number of collections of new objects before one of all objects."""
SHARE = 1 / 20
"""The largest share of the time that collections of all objects take."""


class Sweeper(QObject):
    """Collects while it exists. Afterwards the collector stays switched off."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        gc.disable()
        self._next_full = 0.0
        self._timer = QTimer(self)
        self._timer.timeout.connect(self._sweep)
        self._timer.start(PAUSE)

    def _sweep(self) -> None:
        young, _, rounds = gc.get_count()
        if young < YOUNG:
            return
        began = monotonic()
        if rounds < ROUNDS or began < self._next_full:
            gc.collect(1)
            return
        gc.collect()
        ended = monotonic()
        self._next_full = ended + (ended - began) / SHARE
