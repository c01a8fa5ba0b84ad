"""Loading recordings. A long one is read in a second thread, so that the window does not freeze."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from stat import S_ISFIFO

from PySide6.QtCore import QObject, Signal

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import StudioError
from smsl_studio.front.recordings import Recording, open_recording
from smsl_studio.studio.base.beside import Beside

SHORT = 1 << 19
"""A log up to this size (bytes, about 3,000 events) is read at once."""


class _GivenUpError(Exception):
    """Raised in the reading thread to end it, because reading was cancelled."""


class RecordingReader:
    """One recording that is being read; ``share`` of it is done (0 to 1)."""

    def __init__(self, path: Path) -> None:
        self.path, self.share, self.given_up = path, 0.0, False

    def going(self, share: float) -> None:
        """Note the share that is done (0 to 1); ends the reading if it was cancelled."""
        if self.given_up:
            raise _GivenUpError
        self.share = share


Came = Recording | StudioError | None


class RecordingLoader(QObject):
    """Reads one recording at a time; opening another one cancels the first."""

    began = Signal()
    """Reading of a long recording began, see ``reading``."""
    ended = Signal()
    """Reading ended: done, refused, or cancelled."""
    opened = Signal(object)
    """Recording: it was read."""
    refused = Signal(object)
    """StudioError: it cannot be shown."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.reading: RecordingReader | None = None
        self._beside = Beside(self)

    def open(self, path: Path, drawn: Blueprint) -> None:
        """Read a recording; a short one is emitted before this returns."""
        self.give_up()
        self.reading = reading = RecordingReader(path)
        if _is_short(path):
            self._came(reading, _read(reading, drawn))
            return
        self.began.emit()
        self._beside.do(partial(_read, reading, drawn), partial(self._came, reading))

    def give_up(self) -> None:
        """Cancel reading."""
        if self.reading is not None:
            self.reading.given_up = True
            self.reading = None
            self.ended.emit()

    def stop(self) -> None:
        """End all work, because the window closes."""
        self.give_up()
        self._beside.stop()

    def _came(self, reading: RecordingReader, came: Came) -> None:
        if reading is not self.reading:
            return
        self.reading = None
        self.ended.emit()
        if isinstance(came, Recording):
            self.opened.emit(came)
        elif came is not None:
            self.refused.emit(came)


def _read(reading: RecordingReader, drawn: Blueprint) -> Came:
    try:
        return open_recording(reading.path, drawn, reading.going)
    except StudioError as error:
        return error
    except _GivenUpError:
        return None


def _is_short(path: Path) -> bool:
    """Whether the file is small or missing, so that reading it takes no time.

    A pipe may never end.
    """
    try:
        found = path.stat()
    except OSError:
        return True
    return not S_ISFIFO(found.st_mode) and found.st_size <= SHORT
