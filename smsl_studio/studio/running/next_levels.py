"""The levels that are set for the next run only; they override those of the blueprint."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import QObject, Signal

from smsl_studio.blueprint.levels import Levels, fault_of
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.studio.document.session import Session


class NextLevels(QObject):
    """Keeps these levels while the file is open.

    A level that no longer fits after an edit is dropped.
    """

    changed = Signal()

    def __init__(self, session: Session) -> None:
        super().__init__(session)
        self._session = session
        self._set: dict[str, str] = {}
        session.opened.connect(lambda *_: self.put({}))
        session.blueprint_changed.connect(lambda *_: self._fit())

    @property
    def set(self) -> Mapping[str, str]:
        """The levels by key, see ``Levels``."""
        return dict(self._set)

    def levels(self, blueprint: Blueprint) -> Levels:
        """All levels of a run that begins now."""
        return Levels(blueprint, self._set)

    def put(self, levels: Mapping[str, str]) -> None:
        """Set these levels and no others."""
        if dict(levels) != self._set:
            self._set = dict(levels)
            self.changed.emit()

    def _fit(self) -> None:
        blueprint = self._session.blueprint
        self.put({k: v for k, v in self._set.items() if fault_of(blueprint, k, v) is None})
