"""RecoveryLook: asks in a second thread how a procedure recovers from its failures."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.studio.base.beside import Beside
from smsl_studio.studio.document.inspector import LIMIT
from smsl_studio.studio.document.session import Session

if TYPE_CHECKING:
    from smsl_studio.front.recovery_rows import RecoveryRow


class RecoveryLook(QObject):
    """Answers for the blueprint that is shown, when somebody looks. An edit calls it off."""

    changed = Signal()
    """Other ``rows``, or none as long as they are not known."""

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session, self._beside = session, Beside(self)
        self._asked: Blueprint | None = None
        self.rows: tuple[RecoveryRow, ...] | None = None
        """The rows for the blueprint that is shown; None as long as they are not known."""
        session.blueprint_changed.connect(lambda *_: self._forget())
        session.opened.connect(self._forget)

    def look(self) -> None:
        """Ask, if the answer for this blueprint is neither known nor under way."""
        blueprint = self._session.blueprint
        if self._session.broken is not None or self._asked is blueprint:
            return
        self._asked = blueprint
        self._beside.do(partial(_rows, blueprint), partial(self._came, blueprint))

    def stop(self) -> None:
        """End all work, because the window closes."""
        self._beside.stop()

    def _came(self, blueprint: Blueprint, rows: tuple[RecoveryRow, ...]) -> None:
        if blueprint is self._session.blueprint:
            self.rows = rows
            self.changed.emit()

    def _forget(self) -> None:
        self._beside.drop()
        self._asked = self.rows = None
        self.changed.emit()


def _rows(blueprint: Blueprint) -> tuple[RecoveryRow, ...]:
    """It is called in the worker thread."""
    from smsl_studio.front.recovery_rows import recovery_rows

    return recovery_rows(blueprint, LIMIT)
