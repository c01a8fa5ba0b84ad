"""Nudge: arrow keys move the selected states, and presses soon after each other are one step."""

from __future__ import annotations

import time
from collections.abc import Callable

from PySide6.QtCore import QObject, QTimer

from smsl_studio.blueprint.address import Address
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.document.session import Session

PAUSE = 1.0
"""After so many seconds without a press, the next one begins a new step."""

Moved = tuple[str, tuple[str, ...]]
"""An SB and the names of its states that are moved."""


class Nudge(QObject):
    """Turns ``nudge_wanted`` of a canvas into edits of a session.

    All presses that wait are carried out together. So a key that is held down in a large drawing
    moves the states as far as it was held, and does not go on afterwards.
    """

    def __init__(self, session: Session, canvas: Canvas) -> None:
        super().__init__(canvas)
        self._session, self._canvas = session, canvas
        self.clock: Callable[[], float] = time.monotonic
        """The time in seconds."""
        self._last, self._run = -PAUSE, 0
        self._moved: Moved = "", ()
        self._way: tuple[Moved, float, float] | None = None
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.timeout.connect(self.settle)
        canvas.nudge_wanted.connect(self.move)
        session.settling.connect(self.settle)

    def move(self, dx: float, dy: float) -> None:
        """Move the selected states of the SB that is shown (scene units), in a moment."""
        branch = self._session.branch
        chosen = [a for a in self._session.selection if a.branch == branch and not a.operation]
        moved = branch, tuple(a.state for a in chosen)
        if self._way is not None and self._way[0] != moved:
            self.settle()
        _, x, y = self._way or (moved, 0.0, 0.0)
        self._way = moved, x + dx, y + dy
        self._timer.start(0)

    def settle(self) -> None:
        """Carry out the presses that wait. Edits and commands call it first."""
        self._timer.stop()
        way, self._way = self._way, None
        if way is None or way[0][0] != self._session.branch:
            return
        (branch, names), dx, dy = way
        positions = self._canvas.positions
        places = {n: (positions[n][0] + dx, positions[n][1] + dy) for n in names if n in positions}
        if way[0] != self._moved or self.clock() - self._last >= PAUSE:
            self._run += 1
        self._moved = way[0]
        words = f"Move {names[0] if len(names) == 1 else counted(len(names), 'state')}"
        moved = self._session.places.moved
        self._session.edit(words, lambda bp: moved(bp, branch, places), self._run)
        self._canvas.reveal(Address(branch, names[-1]))
        self._last = self.clock()
