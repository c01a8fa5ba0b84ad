"""EquivalenceLook: compares the behaviour of the drawing and another version."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import StudioError
from smsl_studio.studio.base.beside import Beside
from smsl_studio.studio.document.inspector import LIMIT
from smsl_studio.studio.document.session import Session

if TYPE_CHECKING:
    from smsl_studio.front.views.claim_run import RunStep
    from smsl_studio.inspection.equivalence.equivalence import Equivalence
    from smsl_studio.studio.document.versions import Version

DRAWING = "the drawing"


@dataclass(frozen=True)
class ComparedRuns:
    """The result of a comparison, with a run that shows a difference.

    ``before`` has the steps of this run in the other version, and ``after`` those in the drawing.
    One of them may lack the last step: there the operation is not permitted.
    """

    told: Equivalence
    before: tuple[RunStep, ...] = ()
    after: tuple[RunStep, ...] = ()


class EquivalenceLook(QObject):
    """Compares when the person asks. An edit ends the comparison and removes its result."""

    changed = Signal()
    """``answer`` has changed."""

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session, self._beside = session, Beside(self)
        self.version: Version | None = None
        self.answer: ComparedRuns | StudioError | None = None
        """The result for the present drawing. None until it is known."""
        self.works = False
        self.stopped = False
        """Whether a person has ended the comparison."""
        session.blueprint_changed.connect(lambda *_: self._forget())
        session.opened.connect(self._opened)

    def compare(self, version: Version) -> None:
        """Compare the drawing with a version."""
        self.version = version
        self.again()

    def again(self) -> None:
        """Compare the drawing with the same version again."""
        if self.version is None:
            return
        self._forget()
        self.works = True
        self._beside.do(partial(_compared, self.version, self._session.blueprint), self._came)
        self.changed.emit()

    def call_off(self) -> None:
        """End the comparison, because the person wants it."""
        self._forget()
        self.stopped = True
        self.changed.emit()

    def stop(self) -> None:
        """End all work, because the window closes."""
        self._beside.stop()

    def _came(self, answer: ComparedRuns | StudioError) -> None:
        self.works, self.answer = False, answer
        self.changed.emit()

    def _opened(self) -> None:
        self.version = None
        self.changed.emit()

    def _forget(self) -> None:
        self._beside.drop()
        known = self.answer is not None or self.works or self.stopped
        self.answer, self.works, self.stopped = None, False, False
        if known:
            self.changed.emit()


def _compared(version: Version, drawn: Blueprint) -> ComparedRuns | StudioError:
    """Compare two blueprints. The worker thread calls this."""
    from smsl_studio.front.inputs import must_be_whole
    from smsl_studio.front.views.labelled_run import labelled_run
    from smsl_studio.inspection.equivalence.equivalence import equivalence

    other = version.blueprint
    try:
        for one in (other, drawn):
            must_be_whole(one)
        told = equivalence(other, drawn, LIMIT, names=(version.words, DRAWING))
        if told.equal is not False:
            return ComparedRuns(told)
        runs = (labelled_run(one, told.path) for one in (other, drawn))
        return ComparedRuns(told, *runs)
    except StudioError as error:
        return error
