"""The file of a journal, and the lock beside it that shows that its window is alive.

The system releases the lock when the process ends, in whatever way. A process id would be no proof,
because it may belong to another process by now.
"""

from __future__ import annotations

import os
import sys
from contextlib import suppress
from pathlib import Path

from smsl_studio.smsl.disk import write_new
from smsl_studio.smsl.inputs import read_ordinary

if sys.platform == "win32":
    import msvcrt
else:
    import fcntl

_NO_LINK = getattr(os, "O_NOFOLLOW", 0)
SUFFIX, LOCK = ".journal", ".lock"
LARGEST = 1 << 30
"""The largest journal that is read (bytes)."""


def folder_of(home: Path) -> Path:
    """The folder of all journals in the user's folder."""
    return home / "journal"


class JournalFile:
    """A journal file, locked by this process from ``take`` or ``claim`` until ``let_go``."""

    def __init__(self, path: Path, lock: int) -> None:
        self.path, self._lock = path, lock

    @classmethod
    def take(cls, folder: Path) -> JournalFile:
        """Lock a new file; raises OSError if the folder cannot be written."""
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        while True:
            path = folder / f"{os.getpid()}-{os.urandom(6).hex()}{SUFFIX}"
            place = cls.claim(path)
            if place is not None:
                return place

    @classmethod
    def claim(cls, path: Path) -> JournalFile | None:
        """Lock the journal of a window that is gone; None if another process holds it."""
        name = path.with_suffix(LOCK)
        handle = os.open(name, os.O_RDWR | os.O_CREAT | _NO_LINK, 0o600)
        try:
            _lock(handle)
            # The former holder may have deleted the lock file a moment ago, so this may be a
            # deleted file.
            if not os.path.samestat(os.fstat(handle), os.stat(name)):  # noqa: PTH116
                raise FileNotFoundError(name)
        except OSError:
            os.close(handle)
            return None
        return cls(path, handle)

    def write(self, raw: bytes) -> None:
        """Replace the content of the file as a whole. On OSError the former content stays."""
        fresh = self.path.with_suffix(".part")
        fresh.unlink(missing_ok=True)
        write_new(fresh, raw, 0o600)
        fresh.replace(self.path)

    def read(self) -> bytes:
        """The content of the file; raises OSError if there is none or it is too large."""
        raw = read_ordinary(self.path, LARGEST).raw
        if len(raw) > LARGEST:
            raise OSError(27, "the journal is too large")
        return raw

    def remove(self) -> None:
        """Delete the file and keep the lock."""
        for path in (self.path, self.path.with_suffix(".part")):
            with suppress(OSError):
                path.unlink()

    def let_go(self) -> None:
        """Release the lock. The next start offers a journal that is still there."""
        if self._lock < 0:
            return
        if not self.path.exists():
            with suppress(OSError):
                self.path.with_suffix(LOCK).unlink()
        os.close(self._lock)
        self._lock = -1


def _lock(handle: int) -> None:
    """Lock an open file for this process; raises OSError if another process holds it."""
    if sys.platform == "win32":
        msvcrt.locking(handle, msvcrt.LK_NBLCK, 1)
    else:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
