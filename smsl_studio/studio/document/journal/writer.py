"""The writer of a window's journal.

A change starts a short wait, and further changes do not make it longer. Then the unsaved work is
written in a second thread. So a change is on the disk within a second, and typing never waits for
the disk.
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
"""Milliseconds from a change to the next writing."""
Unsaved = Callable[[int], JournalEntry | None]
"""Returns the unsaved work, given the number of changes; None if all is saved."""


class Journal(QObject):
    """The journal of one window; ``folder`` is the folder of all journals."""

    acknowledged = Signal(int)
    """int: the disk has all work up to this number of changes, or all was saved."""
    failed = Signal(str)
    """str: why the journal cannot be written. Emitted once, until a write succeeds."""

    def __init__(self, unsaved: Unsaved, folder: Path, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._unsaved, self._folder = unsaved, folder
        self._place: JournalFile | None = None
        self._busy = self._again = self._told = self._closed = False
        self.changes = self.safe = 0
        """The number of changes, and up to which of them the disk has the work."""
        self._beside = Beside(self)
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.setInterval(WAIT)
        self._timer.timeout.connect(self._write)

    @property
    def path(self) -> Path | None:
        """The path of the journal; None as long as there was nothing to keep."""
        return self._place.path if self._place is not None else None

    @property
    def whole(self) -> bool:
        """Whether the last write succeeded."""
        return not self._told

    def changed(self) -> None:
        """Note that the work changed or was saved."""
        if self._closed:
            return
        self.changes += 1
        if not self._timer.isActive():
            self._timer.start()

    def flush(self) -> bool:
        """Write now and wait for it; returns whether the journal has unsaved work."""
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
        """Delete the journal, because the work was saved or the person gave it up."""
        self._end()
        if self._place is not None:
            self._place.remove()
            self._place.let_go()

    def leave_behind(self) -> bool:
        """Write the journal and leave it, because the program ends and cannot ask.

        Returns whether the journal has work.
        """
        kept = self.flush()
        self._end()
        if self._place is not None:
            # The last write failed, for example on a full disk. An older journal is better than
            # none.
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
    """Write the entry; returns the error if that failed."""
    try:
        place.write(encode(entry))
    except OSError as error:
        return error
    return None
