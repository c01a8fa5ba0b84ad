"""SameLook: finds the states of the drawing that behave alike, in a second thread."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import StudioError
from smsl_studio.studio.base.beside import Beside
from smsl_studio.studio.document.session import Session

if TYPE_CHECKING:
    from smsl_studio.generate.shapes.same_states import SameStates


class SameLook(QObject):
    """Finds the states that behave alike when the person looks. An edit ends the search."""

    changed = Signal()
    """``answer`` has changed. It is None until the result is known."""

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session, self._beside = session, Beside(self)
        self._asked: Blueprint | None = None
        self.answer: tuple[SameStates, ...] | StudioError | None = None
        session.blueprint_changed.connect(lambda *_: self._forget())

    @property
    def works(self) -> bool:
        """Whether a search is running."""
        return self._asked is not None and self.answer is None

    def look(self) -> None:
        """Search, unless this blueprint has been searched or the search is running."""
        blueprint = self._session.blueprint
        if self._asked is not blueprint:
            self._asked = blueprint
            self._beside.do(partial(_same, blueprint), self._came)

    def stop(self) -> None:
        """End all work, because the window closes."""
        self._beside.stop()

    def _came(self, answer: tuple[SameStates, ...] | StudioError) -> None:
        self.answer = answer
        self.changed.emit()

    def _forget(self) -> None:
        self._beside.drop()
        self._asked = self.answer = None
        self.changed.emit()


def _same(blueprint: Blueprint) -> tuple[SameStates, ...] | StudioError:
    """Find the states that behave alike. The worker thread calls this."""
    from smsl_studio.generate.shapes.same_states import same_states

    try:
        return same_states(blueprint)
    except StudioError as error:
        return error
