"""The file of a journal, and the lock beside it that says whether its window still lives.

The system lets go of the lock when the process ends, however it ends: a number of a process, which
may long belong to another one, is not asked.
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
"""More bytes than any window writes are not read."""


def folder_of(home: Path) -> Path:
    """Where the journals lie in the user's folder."""
    return home / "journal"


class JournalFile:
    """A journal's file, held by this process from ``take`` or ``claim`` until ``let_go``."""

    def __init__(self, path: Path, lock: int) -> None:
        self.path, self._lock = path, lock

    @classmethod
    def take(cls, folder: Path) -> JournalFile:
        """A new place; OSError where the folder cannot be written."""
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        while True:
            path = folder / f"{os.getpid()}-{os.urandom(6).hex()}{SUFFIX}"
            place = cls.claim(path)
            if place is not None:
                return place

    @classmethod
    def claim(cls, path: Path) -> JournalFile | None:
        """The place of a journal whose window has gone; None where somebody holds it."""
        name = path.with_suffix(LOCK)
        handle = os.open(name, os.O_RDWR | os.O_CREAT | _NO_LINK, 0o600)
        try:
            _lock(handle)
            # Whoever held it may have let go of it, and of its name, a moment ago.
            if not os.path.samestat(os.fstat(handle), os.stat(name)):  # noqa: PTH116
                raise FileNotFoundError(name)
        except OSError:
            os.close(handle)
            return None
        return cls(path, handle)

    def write(self, raw: bytes) -> None:
        """Put these bytes in the place of what stands there: whole, or OSError and as it was."""
        fresh = self.path.with_suffix(".part")
        fresh.unlink(missing_ok=True)
        write_new(fresh, raw, 0o600)
        fresh.replace(self.path)

    def read(self) -> bytes:
        """The bytes that stand there; OSError where there are none, or far too many."""
        raw = read_ordinary(self.path, LARGEST).raw
        if len(raw) > LARGEST:
            raise OSError(27, "the journal is too large")
        return raw

    def remove(self) -> None:
        """Nothing is kept any more; the place stays held."""
        for path in (self.path, self.path.with_suffix(".part")):
            with suppress(OSError):
                path.unlink()

    def let_go(self) -> None:
        """Hold it no longer. A journal that stands there is offered at the next start."""
        if self._lock < 0:
            return
        if not self.path.exists():
            with suppress(OSError):
                self.path.with_suffix(LOCK).unlink()
        os.close(self._lock)
        self._lock = -1


def _lock(handle: int) -> None:
    """Lock an open file for this process; OSError where somebody else holds it."""
    if sys.platform == "win32":
        msvcrt.locking(handle, msvcrt.LK_NBLCK, 1)
    else:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
