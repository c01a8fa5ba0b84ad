"""The run log: JSON Lines, a header first, then one event a line, each flushed when written.

The header carries what events must not: wall time, host, versions, the file. After a crash every
line that was written is there; a line that was cut short is dropped when the log is read.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Any

from smsl_studio.errors import Place, ReadError, SaveError
from smsl_studio.runlog.events import Event

Json = Any
FORMAT = "smsl-run"
VERSION = 1


class RunLog:
    """A log that is being written. SaveError where it cannot be, before anything has run."""

    def __init__(self, path: Path, header: Mapping[str, Json]) -> None:
        self.path = path
        try:
            self._file = path.open("wb", buffering=0)
        except OSError as error:
            raise self._failed(error) from None
        try:
            self._put({"log": FORMAT, "version": VERSION, **header})
        except SaveError:
            self._file.close()
            raise

    def write(self, events: Iterable[Event]) -> None:
        """Append events; when it returns, they survive the death of this process."""
        for event in events:
            self._line(event.line())

    def close(self) -> None:
        """End the log; calling it twice is harmless."""
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

    def _put(self, values: Json) -> None:
        self._line(json.dumps(values, ensure_ascii=False, separators=(",", ":")))

    def _line(self, text: str) -> None:
        left = memoryview(f"{text}\n".encode("utf-8", "backslashreplace"))
        try:
            while left:
                left = left[self._file.write(left) or 0 :]
        except OSError as error:
            raise self._failed(error) from None

    def _failed(self, error: OSError) -> SaveError:
        return SaveError(
            f"the run log cannot be written: {error.strerror or error}",
            Place(str(self.path), 1, 1),
            "Free some space or choose another file; without its log a run does not go on.",
        )


@dataclass(frozen=True)
class LoggedRun:
    """A log as read: its header, its events as plain values, whether the end was cut short."""

    header: Mapping[str, Json]
    events: tuple[Mapping[str, Json], ...]
    cut: bool


def read_log(path: Path) -> LoggedRun:
    """A run log from a file; ReadError with the place of what is no log."""
    try:
        raw = path.read_bytes()
    except OSError as error:
        raise ReadError(f"cannot be read: {error.strerror}", Place(str(path), 1, 1)) from None
    *lines, rest = raw.split(b"\n")
    records = [_record(path, number, line) for number, line in enumerate(lines, 1)]
    if not records or records[0].get("log") != FORMAT:
        raise ReadError("this is no run log", Place(str(path), 1, 1), "Choose a file of run --log.")
    return LoggedRun(records[0], tuple(records[1:]), bool(rest))


def _record(path: Path, number: int, line: bytes) -> Mapping[str, Json]:
    try:
        record = json.loads(line)
    except (ValueError, RecursionError):
        record = None
    if not isinstance(record, dict):
        raise ReadError("the line is no JSON object", Place(str(path), number, 1))
    return record
