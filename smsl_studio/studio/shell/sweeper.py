"""Collects garbage in the thread of the windows, and nowhere else.

Python's collector runs in the thread that happens to make the next object. If it frees a widget in
the thread of a run or of a worker, Qt crashes. So it is switched off for the whole program, and a
timer of the windows collects instead.

No collection may be felt, and the time of one grows with the number of objects that it looks at.
A proof beside the window makes millions of them. So new objects are looked at in small portions,
and old ones are set aside (frozen) as soon as they are many. An object that is set aside is still
freed when its last reference goes. Only its cycles of references wait, until a window closes or the
person turns to another program. Then all is looked at.
"""

from __future__ import annotations

import gc
from time import monotonic

from PySide6.QtCore import QObject, QTimer

PAUSE, SOON = 50, 10
"""Milliseconds between two looks at how much was made: as a rule, and while much is made."""
YOUNG = 10_000
"""The number of new objects that are worth a collection."""
MANY = 60_000
"""The number of old objects that are set aside. To look at them takes some milliseconds."""
ROUNDS = 10
"""The number of collections of new objects before one of old objects."""
SHARE = 1 / 20
"""The largest share of the time that collections of old objects take."""


class Sweeper(QObject):
    """Collects while it exists. Afterwards the collector stays switched off."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        gc.disable()
        self._next_old = 0.0
        self._old = 0
        """The number of old objects that are not set aside, at most."""
        self._aside = False
        self._all_wanted = False
        self._timer = QTimer(self)
        self._timer.timeout.connect(self._look)
        self._timer.start(PAUSE)

    def want_all(self) -> None:
        """Look at all objects soon, because something large was given up or nobody looks."""
        self._all_wanted = True

    def sweep(self) -> bool:
        """Collect if much was made. Returns whether it was."""
        young, _, rounds = gc.get_count()
        if young < YOUNG:
            return False
        if self._old + young > MANY:
            gc.collect(1)
            gc.freeze()
            self._old, self._aside = 0, True
            return True
        self._old += young
        began = monotonic()
        if rounds < ROUNDS or began < self._next_old:
            gc.collect(1)
            return True
        self._old = max(self._old - gc.collect(), 0)
        ended = monotonic()
        self._next_old = ended + (ended - began) / SHARE
        return True

    def sweep_all(self) -> None:
        """Look at all objects, also at those that were set aside. This may take a second."""
        self._all_wanted = False
        if self._aside:
            gc.unfreeze()
            gc.collect()
            gc.freeze()
            self._old, self._aside = 0, False

    def _look(self) -> None:
        # While the timer calls, the search must free neither it nor the object that owns it.
        owner = self.parent()
        if self._all_wanted:
            self.sweep_all()
        pause = SOON if self.sweep() else PAUSE
        if owner is not None and self._timer.interval() != pause:
            self._timer.setInterval(pause)
