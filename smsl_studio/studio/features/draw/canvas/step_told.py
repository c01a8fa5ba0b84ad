"""StepTold reads out which step of the history was undone or done again."""

from __future__ import annotations

from smsl_studio.studio.base.announcement import announce
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.document.session import Session


class StepTold:
    """Follows the history of a session. A new step is told by what it selects."""

    def __init__(self, session: Session, canvas: Canvas) -> None:
        self._session, self._canvas = session, canvas
        self._at = session.history.index()
        session.history.indexChanged.connect(self._tell)

    def _tell(self, now: int) -> None:
        before, self._at = self._at, now
        history = self._session.history
        if self._session.adds_step or before == now or not history.count():
            return
        done = "Undone" if now < before else "Done again"
        number = abs(now - before)
        words = history.text(now if now < before else now - 1)
        if number > 1:
            words = counted(number, "step")
        announce(self._canvas, f"{done}: {words}.")
