"""Inspector: inspects the blueprint in a second thread after every change.

The rules are pure functions of a frozen blueprint, so a large one does not freeze the window.
Findings of a blueprint that is no longer shown are dropped. Those of the last ones are kept,
because an undo shows the same blueprint again.
"""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import QObject, QTimer, Signal

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.inspection.inspect import ALL, inspect
from smsl_studio.inspection.rules.finding import Finding
from smsl_studio.studio.base.beside import Beside
from smsl_studio.studio.document.session import Session

KEPT = 40
"""The findings of so many blueprints are kept. An undo shows those of its blueprint at once."""
WAIT = 120
"""Milliseconds from an edit to its inspection; another edit in that time starts the wait again."""


class Inspector(QObject):
    """Keeps the findings of the session's blueprint up to date."""

    found = Signal(object)
    """tuple[Finding]: the findings of the blueprint that is shown now."""
    started = Signal()
    """The blueprint changed, so the former findings may no longer hold."""

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._beside = Beside(self)
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.timeout.connect(self._inspect)
        self._wanted: Blueprint | None = None
        self.findings: tuple[Finding, ...] = ()
        self._known: dict[int, tuple[Blueprint, tuple[Finding, ...]]] = {}
        """The last inspected blueprints with their findings, by the id of the blueprint."""
        self.current = False
        """Whether ``findings`` belong to the blueprint that is shown."""
        session.opened.connect(self._known.clear)
        session.blueprint_changed.connect(lambda *_: self._changed())
        self._changed()

    @property
    def rules(self) -> int:
        """The number of rules that are checked."""
        return len(ALL)

    def stop(self) -> None:
        """End all work, because the window closes."""
        self._timer.stop()
        self._wanted = None
        self._beside.stop()

    def _changed(self) -> None:
        self.current = False
        self.started.emit()
        self._timer.start(0 if id(self._session.blueprint) in self._known else WAIT)

    def _inspect(self) -> None:
        blueprint = self._wanted = self._session.blueprint
        self._beside.drop()
        if id(blueprint) in self._known:
            self._arrived(*self._known[id(blueprint)])
            return
        self._beside.do(partial(inspect, blueprint), partial(self._arrived, blueprint))

    def _arrived(self, blueprint: Blueprint, findings: tuple[Finding, ...]) -> None:
        if blueprint is self._session.blueprint and blueprint is self._wanted:
            self.findings, self.current = findings, True
            self._known[id(blueprint)] = blueprint, findings
            while len(self._known) > KEPT:
                del self._known[next(iter(self._known))]
            self.found.emit(findings)
