"""The log of a run: JSON Lines, each with the SHA-256 of all bytes before it.

The first line is the header, the last one the head: the number of events, and the SHA-256 of all
bytes before. Each line is one unbuffered write, so no event is lost if this process dies.
"""

from __future__ import annotations

import os
import platform
import stat
from collections.abc import Iterable, Mapping
from datetime import datetime, timezone
from hashlib import sha256
from pathlib import Path
from typing import Any

from .errors import UsageError, WorldGone
from .events import Event, line


class RunLog:
    """A log that is being written. The file must be new or empty: a record is never overwritten."""

    def __init__(self, path: str, header: Mapping[str, Any]) -> None:
        self._hash, self._count = sha256(), 0
        try:
            found = Path(path).lstat() if os.path.lexists(path) else None
            if found is not None and (not stat.S_ISREG(found.st_mode) or found.st_size):
                raise UsageError(f"{path} is not empty, or no ordinary file", "Name a new file.")
            self._file = Path(path).open("ab", buffering=0)  # noqa: SIM115
        except (OSError, ValueError) as error:
            raise _failed(error) from None
        self._linked(line({"log": "smsl-run", "version": 3, **header}))
        self._settle()

    def write(self, events: Iterable[Event]) -> None:
        """Append events."""
        for event in events:
            self._linked(line(event))
            self._count += 1

    def finish(self) -> None:
        """Append the head and end the log."""
        head = {"head": {"count": self._count, "hash": self._hash.hexdigest()}}
        self._put(line(head).encode() + b"\n")
        self._settle()
        self._file.close()

    def _linked(self, text: str) -> None:
        before = text[:-1].encode("utf-8", "backslashreplace") + b',"chain":"'
        self._hash.update(before)
        after = self._hash.hexdigest().encode() + b'"}\n'
        self._hash.update(after)
        self._put(before + after)

    def _put(self, raw: bytes) -> None:
        left = memoryview(raw)
        try:
            while left:
                left = left[self._file.write(left) or 0 :]
        except OSError as error:
            raise _failed(error) from None

    def _settle(self) -> None:
        try:
            os.fsync(self._file.fileno())
        except OSError as error:
            raise _failed(error) from None


def _failed(error: OSError | ValueError) -> WorldGone:
    words = getattr(error, "strerror", None) or error
    return WorldGone(f"the run log cannot be written: {words}")


def header(identity: Mapping[str, Any], asked: Mapping[str, Any]) -> dict[str, Any]:
    """Return the header of a log: what was asked for, and what differs between equal runs."""
    return {
        "wall_time": datetime.now(timezone.utc).isoformat(timespec="milliseconds"),
        "node": platform.node(),
        "process": os.getpid(),
        **asked,
        "mqtt": None,
        **identity,
    }
