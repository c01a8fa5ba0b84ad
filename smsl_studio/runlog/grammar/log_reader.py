"""Reads a run log line by line, and says whether it is unchanged.

A log comes from outside. Whatever it contains, the answer is its events, a ReadError with a place,
or a doubt. A doubt is the first reason why the log is not verified: its chain is broken, its order
of events is impossible (see ``grammar``), or it has no end. Its events can be read even so, up to
the last whole line.
"""

from __future__ import annotations

import json
import os
import re
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO

from smsl_studio.errors import Place, ReadError
from smsl_studio.runlog.command_word import CommandWords
from smsl_studio.runlog.decoder import event_of
from smsl_studio.runlog.events import Event
from smsl_studio.runlog.grammar.automaton import Grammar
from smsl_studio.runlog.log import FORMAT, FORMER, LONGEST, VERSION
from smsl_studio.seal.chain import Chain, unlinked
from smsl_studio.smsl.inputs import open_ordinary

Json = Any
Going = Callable[[float], None]
_FIRST = f'{{"log":"{FORMAT}",'.encode("ascii")
_HEAD = re.compile(
    rb'\{"head":(\{"count":(0|[1-9][0-9]{0,17}),"hash":"([0-9a-f]{64})"\})'
    rb'(?:,"signed":(\{.{1,2000}\}))?\}\n'
)
OFTEN = 256
"""The number of events between two reports of progress."""
_LOOKED_AT = 100
"""So many lines are enough to distinguish a log without its header from any other file."""

_DAMAGED = "The log was damaged or changed; take another copy of it."
_NO_LOG = "Choose a file of run --log."
_NO_HEAD = "the log has no head: it was cut, or its run did not come to an end"
IMPOSSIBLE = "the story is impossible: "
"""The first words of a message that says that events are in an impossible order."""
_UNWRITTEN = "the line has content that no run writes"


@dataclass(frozen=True, slots=True)
class LogHead:
    """The last line of a log: the number of events, and the SHA-256 of all bytes before it.

    ``raw`` has the bytes of both, and ``signed`` the envelope with their signature, as the log has
    it. It is empty if nobody has signed the head.
    """

    count: int
    hash: str
    raw: bytes = b""
    signed: bytes = b""


@dataclass(frozen=True, slots=True)
class Doubt:
    """Why a log is not verified, and the first place that shows it."""

    place: Place
    sentence: str

    def __str__(self) -> str:
        return f"{self.place}: not verified: {self.sentence}"


@dataclass(frozen=True, slots=True)
class Record:
    """An event, its line number, and the text that the run printed for it."""

    line: int
    text: str
    event: Event


class LogReader:
    """Reads one log. ``file`` is its name in messages. ``commands`` are the commands of a run.

    ``header``, ``count``, ``head`` and ``doubt`` have what was found so far. A log is verified if
    ``records`` has ended and there is no ``doubt``.
    """

    def __init__(self, stream: BinaryIO, file: str, commands: CommandWords) -> None:
        self.header: Mapping[str, Json] = {}
        self.count = 0
        self.head: LogHead | None = None
        self.doubt: Doubt | None = None
        self._stream, self._file, self._commands = stream, file, commands
        self._chain = Chain()
        self._grammar = Grammar(self.header, commands)
        self._number = 0
        self._seems_log = self._lost = False

    @property
    def version(self) -> int:
        """The version of the log's format, 0 if no header was read yet."""
        return int(self.header.get("version", 0))

    def records(self) -> Iterator[Record]:
        """Read the header, then yield every event. ReadError if a line is not one of a log."""
        first = self._next()
        self._seems_log = _FIRST.startswith(first) or _is_of_log(first)
        self.header = self._header(first)
        self._grammar = Grammar(self.header, self._commands)
        while (line := self._next()).endswith(b"\n"):
            if self.head is not None:
                raise self._wrong("something stands behind the head, which is the last line")
            if line.startswith(b'{"head"'):
                self._end(line)
            else:
                yield self._record(line)
        if line:
            self._doubts("the last line is cut short; it is left out")
        elif self.head is None:
            self._doubts(_NO_HEAD)

    def remains_of_log(self) -> bool:
        """Return whether a file that could not be read is a changed log, and not a file of another
        kind.
        """
        with suppress(ReadError):
            for _ in range(_LOOKED_AT):
                if self._seems_log or not (line := self._next()):
                    break
                self._seems_log = _is_of_log(line)
        return self._seems_log and not self._lost

    def _next(self) -> bytes:
        """Return the next line with its end, empty at the end of the log."""
        self._number += 1
        try:
            line = self._stream.readline(LONGEST + 1)
        except (OSError, ValueError) as error:
            self._lost = True
            raise _unreadable(error, Place(self._file, self._number, 1)) from None
        if len(line) > LONGEST:
            raise self._wrong(f"the line is longer than {LONGEST >> 20} MB")
        return line

    def _header(self, line: bytes) -> Mapping[str, Json]:
        values = self._values(line) if line.startswith(_FIRST) else {}
        if values.get("log") != FORMAT:
            raise self._wrong("this is no run log", advice=_NO_LOG)
        version = values.get("version")
        if type(version) is not int or version not in (FORMER, VERSION):
            raise self._wrong(
                f"this is a run log of another version than {FORMER} and {VERSION}",
                advice="Read it with the program that wrote it.",
            )
        return values

    def _record(self, line: bytes) -> Record:
        values = self._values(line)
        try:
            event = event_of(values)
        except ValueError as error:
            raise self._wrong(str(error)) from None
        self.count += 1
        self._judge(self._grammar.follow(event))
        split = unlinked(line)
        assert split is not None, "a line that was read carries a link"
        return Record(self._number, split[0].decode("utf-8"), event)

    def _values(self, line: bytes) -> dict[str, Json]:
        """Return the values of a line. A wrong link of the chain becomes a doubt."""
        if not line.endswith(b"\n"):
            raise self._wrong("the line is cut short", len(line) + 1)
        split = unlinked(line)
        if split is None:
            raise self._wrong("the line does not end in a link of the chain")
        if not self._chain.holds(line):
            self._doubts("the chain does not hold: this line, or one before it, was changed")
        try:
            values = json.loads(
                split[0].decode("utf-8"), parse_constant=_no_number, object_pairs_hook=_once
            )
        except UnicodeDecodeError as error:
            column = len(split[0][: error.start].decode("utf-8")) + 1
            raise self._wrong("the line is not UTF-8", column) from None
        except json.JSONDecodeError as error:
            raise self._wrong("the line is no JSON object", error.colno) from None
        except _TwiceError as error:
            raise self._wrong(f"{_UNWRITTEN}: {error}") from None
        except (ValueError, RecursionError):
            raise self._wrong(_UNWRITTEN) from None
        if not isinstance(values, dict):
            raise self._wrong("the line is no JSON object")
        return values

    def _end(self, line: bytes) -> None:
        found = _HEAD.fullmatch(line)
        if found is None:
            raise self._wrong("the head is not as it was written")
        self.head = LogHead(int(found[2]), found[3].decode("ascii"), found[1], found[4] or b"")
        if self.head.count != self.count:
            self._doubts(f"the head counts {self.head.count} events; there are {self.count}")
        elif self.head.hash != self._chain.digest:
            self._doubts("the head does not fit: it, or a line before it, was changed")
        self._judge(self._grammar.end())

    def _judge(self, why: str) -> None:
        """Note why a line is impossible, if the grammar says so."""
        if why:
            self._doubts(f"{IMPOSSIBLE}{why}")

    def _doubts(self, sentence: str) -> None:
        if self.doubt is None:
            self.doubt = Doubt(Place(self._file, self._number, 1), sentence)

    def _wrong(self, sentence: str, column: int = 1, advice: str = _DAMAGED) -> ReadError:
        return ReadError(sentence, Place(self._file, self._number, column), advice)


@dataclass(frozen=True)
class LoggedRun:
    """A whole log: its header, its events, its head, and the reason if it is not verified."""

    header: Mapping[str, Json]
    records: tuple[Record, ...]
    head: LogHead | None
    doubt: Doubt | None

    @property
    def events(self) -> tuple[Event, ...]:
        """The events of the log, in order."""
        return tuple(one.event for one in self.records)


@dataclass(frozen=True, slots=True)
class LogVerdict:
    """Whether a log is unchanged and possible.

    It has the number of events, the head, the reason if the log is not verified, and the version of
    its format (0 without a header). ``order`` is set if the run agrees with its blueprint, but its
    events are in an unusual order. ``signer`` is who has signed the head; it is empty if nobody
    has.
    """

    events: int
    head: LogHead | None
    doubt: Doubt | None
    version: int = 0
    order: Doubt | None = None
    signer: str = ""


def open_log(path: Path) -> BinaryIO:
    """Open the log in an ordinary file. ReadError if it cannot be opened."""
    try:
        return os.fdopen(open_ordinary(path), "rb")
    except (OSError, ValueError) as error:
        raise _unreadable(error, Place(str(path), 1, 1)) from None


def read_log(path: Path, commands: CommandWords, going: Going | None = None) -> LoggedRun:
    """Return the run log in a file. ReadError, with the place, if it is not a log.

    ``commands`` are the commands of a run. A log with other commands gets a doubt.

    ``going`` is called sometimes with the share of the bytes that were read (0 to 1). It may raise
    an error, which ends the reading of a long log.
    """
    with open_log(path) as stream:
        size = max(os.fstat(stream.fileno()).st_size, 1)
        if going is None or not stream.seekable():
            return read_records(stream, str(path), commands)
        tell = going
        return read_records(
            stream, str(path), commands, lambda: tell(min(stream.tell() / size, 1.0))
        )


def read_records(
    stream: BinaryIO, file: str, commands: CommandWords, going: Callable[[], None] | None = None
) -> LoggedRun:
    """Return the run log in a stream. ReadError, with the place, if it is not a log.

    ``going`` is called sometimes, and may raise an error.
    """
    reader = LogReader(stream, file, commands)
    records = []
    for record in reader.records():
        records.append(record)
        if going is not None and len(records) % OFTEN == 0:
            going()
    return LoggedRun(reader.header, tuple(records), reader.head, reader.doubt)


def verify(stream: BinaryIO, file: str, commands: CommandWords) -> LogVerdict:
    """Check the chain over the raw bytes, the head and the order of events of a log.

    ReadError if there is no log to check: its bytes cannot be read, or it is another file.
    """
    reader = LogReader(stream, file, commands)
    try:
        for _ in reader.records():
            pass
    except ReadError as error:
        if not reader.remains_of_log():
            raise
        doubt = Doubt(error.place or Place(file, 1, 1), error.sentence)
        return LogVerdict(reader.count, None, reader.doubt or doubt, reader.version)
    return LogVerdict(reader.count, reader.head, reader.doubt, reader.version)


def _is_of_log(line: bytes) -> bool:
    """Return whether a log can have this line, from its beginning or its end."""
    return line.startswith((_FIRST, b'{"head":{"count":')) or unlinked(line) is not None


def _unreadable(error: OSError | ValueError, place: Place) -> ReadError:
    reason = getattr(error, "strerror", None) or error
    advice = "Check the path and the right to read it."
    return ReadError(f"the run log cannot be read: {reason}", place, advice)


class _TwiceError(ValueError):
    """A key that stands twice in an object. Readers differ in which of the two they use."""


def _once(pairs: list[tuple[str, Json]]) -> dict[str, Json]:
    found = dict(pairs)
    if len(found) < len(pairs):
        many = Counter(key for key, _ in pairs)
        raise _TwiceError(f"{many.most_common(1)[0][0][:40]!r} stands in it twice")
    return found


def _no_number(word: str) -> Json:
    raise ValueError(f"{word} is no number")
