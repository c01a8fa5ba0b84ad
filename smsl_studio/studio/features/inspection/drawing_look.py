"""DrawingLook: answers a question about the drawing in a second thread."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Generic, TypeVar

from PySide6.QtCore import QObject, Signal

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import StudioError
from smsl_studio.studio.base.beside import Beside
from smsl_studio.studio.document.inspector import LIMIT
from smsl_studio.studio.document.session import Session

if TYPE_CHECKING:
    from smsl_studio.front.recovery_rows import RecoveryRow
    from smsl_studio.generate.shapes.same_states import SameStates

Answer = TypeVar("Answer")


class DrawingLook(QObject, Generic[Answer]):
    """Answers a question about the drawing when the person looks. An edit ends the search.

    The worker thread calls ``question``.
    """

    changed = Signal()
    """``answer`` has changed. It is None until the result is known."""

    def __init__(
        self, session: Session, question: Callable[[Blueprint], Answer], parent: QObject
    ) -> None:
        super().__init__(parent)
        self._session, self._question, self._beside = session, question, Beside(self)
        self._asked: Blueprint | None = None
        self.answer: Answer | None = None
        """The answer for the drawing. None until it is known."""
        session.blueprint_changed.connect(lambda *_: self._forget())
        session.opened.connect(self._forget)

    def look(self) -> None:
        """Search, unless this blueprint has been searched or the search is running."""
        blueprint = self._session.blueprint
        if self._asked is not blueprint:
            self._asked = blueprint
            self._beside.do(partial(self._question, blueprint), self._came)

    def stop(self) -> None:
        """End all work, because the window closes."""
        self._beside.stop()

    def _came(self, answer: Answer) -> None:
        self.answer = answer
        self.changed.emit()

    def _forget(self) -> None:
        self._beside.drop()
        known = self._asked is not None or self.answer is not None
        self._asked = self.answer = None
        if known:
            self.changed.emit()


def recovery_of(blueprint: Blueprint) -> tuple[RecoveryRow, ...]:
    """Return how the procedure recovers from each of its failures."""
    from smsl_studio.front.recovery_rows import recovery_rows

    return recovery_rows(blueprint, LIMIT)


def same_in(blueprint: Blueprint) -> tuple[SameStates, ...] | StudioError:
    """Find the states that behave alike, or say why they are not known."""
    from smsl_studio.generate.shapes.same_states import same_states

    try:
        return same_states(blueprint)
    except StudioError as error:
        return error
