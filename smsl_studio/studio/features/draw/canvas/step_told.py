"""StepTold reads out which step of the history was undone or done again."""

from __future__ import annotations

from smsl_studio.studio.base.announcement import announce
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.canvas.step_views import StepViews


class StepTold:
    """Follows the history of a session. A new step is told by what it selects.

    It is made after ``views``, which tells by itself what was undone in another SB.
    """

    def __init__(self, session: Session, canvas: Canvas, views: StepViews) -> None:
        self._session, self._canvas, self._said = session, canvas, False
        self._at = session.history.index()
        views.told.connect(self._told)
        session.stepped.connect(self._tell)

    def _told(self, _: str) -> None:
        self._said = True

    def _tell(self, now: int) -> None:
        before, self._at = self._at, now
        history, said, self._said = self._session.history, self._said, False
        if said or self._session.adds_step or before == now or not history.count():
            return
        done = "Undone" if now < before else "Done again"
        number = abs(now - before)
        words = history.text(now if now < before else now - 1)
        if number > 1:
            words = counted(number, "step")
        announce(self._canvas, f"{done}: {words}.")
