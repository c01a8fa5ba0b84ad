"""The exploration of a window: its process, and what it has found so far."""

from __future__ import annotations

from collections import deque
from contextlib import closing

from PySide6.QtCore import QObject, QTimer, Signal

from smsl_studio.errors import StudioError
from smsl_studio.front.attempts import TriedState, Values
from smsl_studio.front.exploration_child import ExplorationChild, ExplorationRequest
from smsl_studio.front.physics import ExploredRows
from smsl_studio.studio.base.beside import Beside

NONE, RUNNING, PAUSED, DONE = "", "running", "paused", "done"
LOOK = 150
"""Milliseconds between two looks at what was heard."""


class PhysicsWork(QObject):
    """Runs one exploration at a time. ``found`` has what was found so far, ``tried`` is the number
    of states that were tried."""

    changed = Signal()
    """The phase or what is found changed."""
    refused = Signal(object)
    """A StudioError: the exploration cannot go on. What was tried is kept."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.phase = NONE
        self.request: ExplorationRequest | None = None
        self.found, self.tried = ExploredRows(), 0
        self._beside = Beside(self)
        self._heard: deque[tuple[Values, TriedState]] = deque()
        self._timer = QTimer(self)
        self._timer.setInterval(LOOK)
        self._timer.timeout.connect(self._take)

    def start(self, request: ExplorationRequest) -> None:
        """Begin, or go on: what ``request.part`` has is not tried again."""
        self.pause()
        (branch,) = request.start
        self.request, self.phase = request, RUNNING
        self.found, self.tried = ExploredRows({branch.facts(branch.initial): {}}), 0
        heard = self._heard = deque()

        def work() -> StudioError | None:
            """Follow the process, in the worker thread."""
            try:
                with closing(ExplorationChild(request)) as child:
                    child.follow(lambda values, row: heard.append((values, row)))
            except StudioError as error:
                return error
            return None

        self._beside.do(work, self._end)
        self._timer.start()
        self.changed.emit()

    def pause(self) -> None:
        """End the process. The state that it tries just now is tried again later."""
        if self.phase == RUNNING:
            self._beside.drop()
            self._take()
            self._rest(PAUSED)

    def resume(self) -> None:
        """Go on with what was paused."""
        if self.phase == PAUSED and self.request is not None:
            self.start(self.request)

    def forget(self) -> None:
        """Forget all that was tried."""
        self.pause()
        if self.request is not None:
            self.request.part.unlink(missing_ok=True)
        self.request, self.phase = None, NONE
        self.found, self.tried = ExploredRows(), 0
        self.changed.emit()

    def shut(self) -> None:
        """End all work, because the window closes."""
        self._timer.stop()
        self._beside.stop()

    def _take(self) -> None:
        """Take what was heard since the last look."""
        if not self._heard or self.request is None:
            return
        while self._heard:
            values, row = self._heard.popleft()
            self.found.add(values, row, self.request.limit)
            self.tried += 1
        self.changed.emit()

    def _end(self, came: StudioError | None) -> None:
        self._take()
        if came is None:
            self._rest(DONE)
            return
        self._rest(PAUSED if self.tried else NONE)
        self.refused.emit(came)

    def _rest(self, phase: str) -> None:
        self.phase = phase
        self._timer.stop()
        self.changed.emit()
