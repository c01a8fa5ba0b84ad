"""Opening recordings beside the window: a long one is read while the window goes on working."""

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
"""Bytes of a log that is read before anybody could look up: some 3,000 events."""


class _GivenUpError(Exception):
    """Nobody waits for it any more."""


class RecordingReader:
    """One recording that is being read; ``share`` of it is (0 to 1)."""

    def __init__(self, path: Path) -> None:
        self.path, self.share, self.given_up = path, 0.0, False

    def going(self, share: float) -> None:
        """Note how much is read (0 to 1); stop reading where it was given up."""
        if self.given_up:
            raise _GivenUpError
        self.share = share


Came = Recording | StudioError | None


class RecordingLoader(QObject):
    """One recording at a time; another one takes its place."""

    began = Signal()
    """A long recording is being read: see ``reading``."""
    ended = Signal()
    """It is read, refused, or was given up."""
    opened = Signal(object)
    """A Recording: it is there."""
    refused = Signal(object)
    """A StudioError: it cannot be shown."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.reading: RecordingReader | None = None
        self._beside = Beside(self)

    def open(self, path: Path, drawn: Blueprint) -> None:
        """Read a recording; a short one is there when this returns."""
        self.give_up()
        self.reading = reading = RecordingReader(path)
        if _is_short(path):
            self._came(reading, _read(reading, drawn))
            return
        self.began.emit()
        self._beside.do(partial(_read, reading, drawn), partial(self._came, reading))

    def give_up(self) -> None:
        """Read no further; nothing comes of it."""
        if self.reading is not None:
            self.reading.given_up = True
            self.reading = None
            self.ended.emit()

    def stop(self) -> None:
        """The window goes away."""
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
    """Whether nobody has to wait for it: a small file, or none; a pipe may take for ever."""
    try:
        found = path.stat()
    except OSError:
        return True
    return not S_ISFIFO(found.st_mode) and found.st_size <= SHORT
