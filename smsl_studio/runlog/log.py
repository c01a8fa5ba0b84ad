"""The run log that is being written: JSON Lines with a chain of hashes.

The first line is the header. It has what the events do not have (wall time, host, versions, the
file) and what was asked for. Then each event has a line: the bytes that the run prints, followed by
a link of the chain (see ``seal.chain``). The last line is the head: the number of events, and the
SHA-256 of all bytes before it. A log without a head was cut, or its run did not come to an end.

Each line is one unbuffered write before anybody is told of its event. So no event is lost if this
process dies, not even by kill -9. The log waits for the disk (fsync) only after the header and
after the head, because a stop would have to wait too. A power failure may therefore lose the last
seconds of a run. The missing head then shows this.
"""

from __future__ import annotations

import errno
import json
import os
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any

from smsl_studio.errors import Place, SaveError
from smsl_studio.legible import json_text
from smsl_studio.seal.chain import Chain
from smsl_studio.smsl.outputs import open_new

if TYPE_CHECKING:
    from smsl_studio.runlog.events import Event

Json = Any
Seal = Callable[[bytes], Mapping[str, Json]]
"""Signs the bytes of a head, and returns the envelope with the signature."""
FORMAT = "smsl-run"
VERSION = 3
"""Version 1 had no chain. In version 2 goals were told without a fresh check, and the header had no
``grounds``.
"""
FORMER = 2
"""The former version, which can still be read."""

LONGEST = 1 << 24
"""The largest number of bytes of a line, for writing and for reading."""

_NO_DISK = (errno.EINVAL, errno.ENOTSUP, errno.EROFS)
"""The errors of fsync on a file system that does not support it."""


class RunLog:
    """A log that is being written. SaveError if it cannot be written, before anything has run.

    UsageError if the file is not empty, because a record is never overwritten. The file must be an
    ordinary file and not a link, because nobody can wait for the disk behind a pipe. ``seal`` signs
    the head; without it the head has no signature.
    """

    def __init__(self, path: Path, header: Mapping[str, Json], seal: Seal | None = None) -> None:
        self.path = path
        self._seal = seal
        self._chain = Chain()
        self._count = 0
        try:
            self._file = open_new(path)
        except (OSError, ValueError) as error:
            raise self._failed(error) from None
        try:
            self._linked(_line({"log": FORMAT, "version": VERSION, **header}))
            self._settle()
        except SaveError:
            self._file.close()
            raise

    def write(self, events: Iterable[Event]) -> None:
        """Append events. When it returns, they survive the death of this process."""
        for event in events:
            self._linked(event.line())
            self._count += 1

    def finish(self) -> None:
        """Append the head and end the log. When it returns, everything is on the disk."""
        head = {"count": self._count, "hash": self._chain.digest}
        signed = self._seal(_line(head).encode("ascii")) if self._seal is not None else None
        last = {"head": head} if signed is None else {"head": head, "signed": signed}
        self._put(_line(last).encode("ascii") + b"\n")
        self._settle()
        self.close()

    def close(self) -> None:
        """End the log as it is, without a head. A second call does nothing."""
        self._file.close()

    def __enter__(self) -> RunLog:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def _linked(self, text: str) -> None:
        self._put(self._chain.linked(text.encode("utf-8", "backslashreplace")))

    def _put(self, line: bytes) -> None:
        if len(line) > LONGEST:
            raise self._failed(OSError(errno.EFBIG, f"a line is longer than {LONGEST >> 20} MB"))
        left = memoryview(line)
        try:
            while left:
                left = left[self._file.write(left) or 0 :]
        except OSError as error:
            raise self._failed(error) from None

    def _settle(self) -> None:
        try:
            os.fsync(self._file.fileno())
        except OSError as error:
            if error.errno not in _NO_DISK:
                raise self._failed(error) from None

    def _failed(self, error: OSError | ValueError) -> SaveError:
        return SaveError(
            f"the run log cannot be written: {getattr(error, 'strerror', None) or error}",
            Place(str(self.path), 1, 1),
            "Free some space or choose another file; without its log a run does not go on.",
        )


def _line(values: Json) -> str:
    return json_text(json.dumps(values, ensure_ascii=False, separators=(",", ":")))
