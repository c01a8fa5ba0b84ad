"""Unproved: how many hazards and properties are not known to hold now."""

from __future__ import annotations

from PySide6.QtCore import QObject, Signal

from smsl_studio.inspection.proof.verdict import HOLDS
from smsl_studio.studio.document.inspector import Inspector
from smsl_studio.studio.document.session import Session


class Unproved(QObject):
    """Counts those that fail or are unknown, from the verdicts of the inspector."""

    counted = Signal(int)

    def __init__(self, session: Session, inspector: Inspector) -> None:
        super().__init__(inspector)
        self._session, self._inspector, self._written = session, inspector, 0
        session.opened.connect(self._opened)
        session.broken_changed.connect(self._unknown)
        inspector.started.connect(self._unknown)
        inspector.listed.connect(self._listed)
        inspector.proved.connect(self._proved)

    def _opened(self) -> None:
        self._written = 0
        self._unknown()

    def _listed(self) -> None:
        if not self._written and self._session.broken is None:
            self._written = len(self._inspector.unanswered)
            self._unknown()

    def _unknown(self) -> None:
        """Until they are answered again, all of them are unknown."""
        self.counted.emit(self._written)

    def _proved(self) -> None:
        if self._session.broken is None:
            rows = self._inspector.rows
            self._written = len(rows)
            self.counted.emit(sum(one.verdict != HOLDS for one in rows))
