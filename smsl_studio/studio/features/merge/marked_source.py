"""MarkedSource: the open text while it has the conflict markers of a merge by lines."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal

from smsl_studio.errors import ReadError
from smsl_studio.smsl.document.conflict_markers import is_marked, unmarked
from smsl_studio.studio.base.beside import Beside
from smsl_studio.studio.base.words import counted, refusal_words
from smsl_studio.studio.document.broken import Broken
from smsl_studio.studio.document.files.files import Files
from smsl_studio.studio.document.session import Session

if TYPE_CHECKING:
    from smsl_studio.front.marked_files import MarkedMerge

STEP = "Merge by meaning"


class MarkedSource(QObject):
    """Knows whether the open text has conflict markers, and merges it by what it means."""

    merged = Signal(object)
    """MarkedMerge: the text was replaced by the merged one, as one step of the history."""
    refused = Signal(str)
    """str: why it cannot be merged."""

    def __init__(self, session: Session, files: Files, parent: QObject) -> None:
        super().__init__(parent)
        self._session, self._files = session, files
        self._beside = Beside(self)

    @property
    def exists(self) -> bool:
        """Whether the open text has conflict markers."""
        return self._broken is not None

    @property
    def _broken(self) -> Broken | None:
        broken = self._session.broken
        own = broken is not None and broken.file == self._session.blueprint.file
        return broken if broken is not None and own and is_marked(broken.text) else None

    @property
    def places(self) -> int:
        """The number of marked places; 0 if the markers do not belong together."""
        broken = self._broken
        if broken is None:
            return 0
        try:
            return len(unmarked(broken.text, broken.file).lines)
        except ReadError:
            return 0

    @property
    def words(self) -> str:
        """What the text is, in a sentence."""
        places = self.places
        name = self._files.name
        if not places:
            return f"{name} has conflict markers that do not belong together"
        return f"{name} has the conflict markers of a merge by lines, in {counted(places, 'place')}"

    @property
    def fault(self) -> str:
        """Why the markers cannot be read; empty if they can."""
        broken = self._broken
        if broken is None or self.places:
            return ""
        return _told(broken.error)

    def merge(self) -> None:
        """Merge the text by what it means, in the background."""
        broken = self._broken
        if broken is None:
            return
        self._beside.drop()
        work = partial(_tried, broken.text, broken.file, self._files.path)
        self._beside.do(work, partial(self._came, broken))

    def stop(self) -> None:
        """End all work, because the window closes."""
        self._beside.stop()

    def _came(self, broken: Broken, done: MarkedMerge | ReadError) -> None:
        if self._session.broken is not broken:
            return  # The text was edited in the meantime.
        if isinstance(done, ReadError):
            self.refused.emit(_told(done))
            return
        self._session.take(STEP, done.merge.blueprint, broken.file)
        self.merged.emit(done)


def _tried(text: str, file: str, path: Path | None) -> MarkedMerge | ReadError:
    from smsl_studio.front.marked_files import merge_marked

    try:
        return merge_marked(text, file, path)
    except ReadError as error:
        return error


def _told(error: ReadError) -> str:
    where = f"Line {error.place.line}: " if error.place else ""
    return f"{where}{refusal_words(error)}"
