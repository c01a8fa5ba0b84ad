"""Where a command writes: data to standard output, everything else to standard error."""

from __future__ import annotations

import contextlib
import json
import os
import select
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any, TextIO

from smsl_studio.errors import ReadError, SaveError, StudioError
from smsl_studio.legible import json_text, one_line
from smsl_studio.stop import BrokenOff

_RED, _GREEN, _YELLOW, _PLAIN = "\x1b[31m", "\x1b[32m", "\x1b[33m", "\x1b[0m"


class Output:
    """The data of one command: lines of text, or JSON, one object a line."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream
        self._colours = stream.isatty() and not os.environ.get("NO_COLOR")

    def line(self, text: str) -> None:
        """Write one line, or several in one text; it is flushed when this returns."""
        self.text(f"{text}\n")

    def text(self, text: str) -> None:
        """Write a text as it is.

        SaveError where it cannot be written; BrokenPipeError where nobody reads it any more. Where
        writing is broken off because the reader takes nothing in, the rest is lost.
        """
        try:
            self._stream.write(text)
            self._stream.flush()
        except BrokenPipeError:
            raise
        except BrokenOff:
            lead_nowhere(self._stream)
            raise
        except OSError as error:
            words = f"standard output cannot be written: {error.strerror or error}"
            raise SaveError(words, advice="Free some room, or send it elsewhere.") from None

    def json(self, value: Any) -> None:
        """One JSON object on a line of its own; its values are exact, whatever they hold."""
        self.line(json_text(json.dumps(value, ensure_ascii=False)))

    def plain(self, text: str) -> str:
        """The text without a colour."""
        return text

    def red(self, text: str) -> str:
        """The text in red, where the output shows colours."""
        return self._in(_RED, text)

    def green(self, text: str) -> str:
        """The text in green, where the output shows colours."""
        return self._in(_GREEN, text)

    def yellow(self, text: str) -> str:
        """The text in yellow, where the output shows colours."""
        return self._in(_YELLOW, text)

    def _in(self, colour: str, text: str) -> str:
        return f"{colour}{text}{_PLAIN}" if self._colours else text


def lead_nowhere(stream: TextIO) -> None:
    """Throw away what is still to be written to a stream, so that nobody waits for its reader."""
    with contextlib.suppress(OSError, ValueError, AttributeError):
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, stream.fileno())
        os.close(nowhere)


def note(text: str) -> None:
    """A note for people, one line on standard error; lost where that is closed or full."""
    if sys.stderr is not None:
        with contextlib.suppress(OSError):
            print(one_line(text), file=sys.stderr, flush=True)


def note_losses(file: str) -> None:
    """Tell before a file is replaced what it loses by that: its owner, rights, further names."""
    from smsl_studio.smsl.traits import losses

    with contextlib.suppress(OSError):  # where it cannot be tried, the save itself will say why
        lost = losses(Path(os.path.realpath(file)))
        if lost:
            note(f"{file}: saved, it loses {', '.join(lost)}.")


def last_note(text: str) -> None:
    """The note of a command that was stopped; it is lost where standard error takes nothing in."""
    try:
        taken_in = select.select([], [sys.stderr.fileno()], [], 0.0)[1]
    except (OSError, ValueError, AttributeError):  # it is closed, or replaced in Python
        taken_in = [2]
    if taken_in:
        note(text)


def report(error: StudioError, name: str) -> None:
    """An expected error: what is wrong with its place, then the advice, one line each.

    For a text that cannot be read, all faults are reported.
    """
    for one in error.faults if isinstance(error, ReadError) else (error,):
        note(str(one) if one.place else f"{name}: {one}")
        if one.advice:
            note(one.advice)


@contextlib.contextmanager
def claimed_stdout() -> Iterator[TextIO]:
    """Standard output for our data alone: what other code prints goes to standard error.

    So prints of library code, and of C code below it, do not mix with the data. Where standard
    output was already replaced in Python, the hosts keep prints apart by themselves; where it is
    closed, the data goes nowhere.
    """
    if sys.stdout is None:
        with open(os.devnull, "w", encoding="utf-8") as nowhere:  # noqa: PTH123
            yield nowhere
        return
    if sys.stderr is None:
        _hold_place_of_stderr()
    try:
        ours = sys.stdout.fileno() == 1
    except (AttributeError, OSError, ValueError):
        ours = False
    if not ours:
        yield sys.stdout
        return
    sys.stdout.flush()
    kept = os.dup(1)
    encoding = sys.stdout.encoding or "utf-8"
    stream = os.fdopen(os.dup(kept), "w", encoding=encoding, errors="backslashreplace")
    os.dup2(2, 1)
    try:
        yield stream
    finally:
        os.dup2(kept, 1)
        os.close(kept)
        with contextlib.suppress(OSError):
            stream.close()


def _hold_place_of_stderr() -> None:
    """Open file number 2 where standard error is closed, so that our data does not get that
    number."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    if nowhere != 2:
        os.dup2(nowhere, 2)
        os.close(nowhere)
