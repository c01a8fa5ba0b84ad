"""Says what a step brought about that its author may not expect."""

from __future__ import annotations

from PySide6.QtCore import QObject

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.studio.base.toast import Toast
from smsl_studio.studio.document.notices import step_notice
from smsl_studio.studio.document.session import Session


class Consequences(QObject):
    """Shows the notice about each new step of ``session`` in ``toast``, with Undo where the step
    changed what nobody asked for."""

    def __init__(self, session: Session, toast: Toast, parent: QObject) -> None:
        super().__init__(parent)
        self._session, self._toast = session, toast
        self._warned = False
        session.opened.connect(self._forget)
        session.blueprint_changed.connect(self._say)

    def _forget(self) -> None:
        self._warned = False

    def _say(self, before: Blueprint, after: Blueprint) -> None:
        # An undo or redo gives nothing that was not there before.
        if not self._session.adds_step:
            return
        notice = step_notice(before, after)
        if notice.sentence and notice.once:
            # Each new state becomes activating until one is chosen. Once is enough.
            if self._warned:
                return
            self._warned = True
        undo = self._session.history.undo if notice.undo else None
        self._toast.of_step(notice.sentence, notice.severity, undo)
