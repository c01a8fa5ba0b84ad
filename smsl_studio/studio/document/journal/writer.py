"""Keeps a window's journal up to date while it holds unsaved work.

A change starts a short wait, which further changes do not make longer; what stands then is encoded
and written beside the window's thread. So a change is on the disk within a second, and typing never
waits for the disk.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path

from PySide6.QtCore import QObject, QTimer, Signal

from smsl_studio.studio.base.beside import Beside
from smsl_studio.studio.document.journal.entry import JournalEntry, encode
from smsl_studio.studio.document.journal.place import JournalFile

WAIT = 300
"""Milliseconds from a change to the writing of what stands then."""
Unsaved = Callable[[int], JournalEntry | None]
"""The unsaved work as it stands, given the number of changes; None where all is saved."""


class Journal(QObject):
    """The journal of one window; ``folder`` is where all of them lie."""

    acknowledged = Signal(int)
    """The disk holds the work as it stood after so many changes (or all of it was saved)."""
    failed = Signal(str)
    """The journal cannot be written; said once until it works again."""

    def __init__(self, unsaved: Unsaved, folder: Path, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._unsaved, self._folder = unsaved, folder
        self._place: JournalFile | None = None
        self._busy = self._again = self._told = self._closed = False
        self.changes = self.safe = 0
        """How many changes there were, and how many of them the disk holds."""
        self._beside = Beside(self)
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.setInterval(WAIT)
        self._timer.timeout.connect(self._write)

    @property
    def path(self) -> Path | None:
        """Where the journal lies, once there was something to keep."""
        return self._place.path if self._place is not None else None

    @property
    def whole(self) -> bool:
        """Whether the disk took what it was last given."""
        return not self._told

    def changed(self) -> None:
        """The work is another now, or is saved now."""
        if self._closed:
            return
        self.changes += 1
        if not self._timer.isActive():
            self._timer.start()

    def flush(self) -> bool:
        """Write now and wait for the disk; whether unsaved work stands in the journal."""
        self._timer.stop()
        self._beside.wait()
        entry = self._unsaved(self.changes)
        if entry is None:
            return False
        try:
            self._held().write(encode(entry))
        except OSError as error:
            self._fail(error)
            return False
        self._done(entry.changes)
        return True

    def close(self) -> None:
        """The window closes and its work is saved, or given up by the person."""
        self._end()
        if self._place is not None:
            self._place.remove()
            self._place.let_go()

    def leave_behind(self) -> bool:
        """The program ends and nobody can be asked: keep it; whether there is something kept."""
        kept = self.flush()
        self._end()
        if self._place is not None:
            # No room for the last of it: what was kept before is better than nothing.
            kept = kept or (not self.whole and self._place.path.exists())
            if not kept:
                self._place.remove()
            self._place.let_go()
            self._place = None
        return kept

    def _end(self) -> None:
        self._closed = True
        self._timer.stop()
        self._beside.drop()
        self._beside.wait()
        self._beside.stop()

    def _held(self) -> JournalFile:
        if self._place is None:
            self._place = JournalFile.take(self._folder)
        return self._place

    def _write(self) -> None:
        if self._busy:
            self._again = True
            return
        entry = self._unsaved(self.changes)
        if entry is None:
            if self._place is not None:
                self._place.remove()
            self._done(self.changes)
            return
        try:
            place = self._held()
        except OSError as error:
            self._fail(error)
            return
        self._busy = True
        self._beside.do(partial(_write, place, entry), partial(self._arrived, entry.changes))

    def _arrived(self, changes: int, error: OSError | None) -> None:
        self._busy = False
        if self._closed:
            return
        if error is not None:
            self._fail(error)
        else:
            self._done(changes)
        if self._again:
            self._again = False
            self._write()

    def _done(self, changes: int) -> None:
        self._told = False
        self.safe = changes
        self.acknowledged.emit(changes)

    def _fail(self, error: OSError) -> None:
        if not self._told:
            self._told = True
            why = error.strerror or str(error)
            self.failed.emit(
                f"Unsaved work cannot be kept in {self._folder}: {why}. Save often until it can."
            )


def _write(place: JournalFile, entry: JournalEntry) -> OSError | None:
    """Put the entry on the disk; why that went wrong."""
    try:
        place.write(encode(entry))
    except OSError as error:
        return error
    return None
