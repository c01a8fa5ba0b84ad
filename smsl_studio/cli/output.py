"""The output of a command: data goes to standard output, all notes go to standard error."""

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
    """Writes the data of one command: lines of text, or JSON with one object on each line."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream
        self._colours = stream.isatty() and not os.environ.get("NO_COLOR")

    def line(self, text: str) -> None:
        """Write one line, or several lines in one text, and flush it."""
        self.text(f"{text}\n")

    def text(self, text: str) -> None:
        """Write a text unchanged, and flush it.

        SaveError if it cannot be written. BrokenPipeError if the reader has closed the pipe. If a
        stop interrupts the writing, the rest of the text is lost.
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
        """Write one JSON object on a line of its own. Hidden characters become JSON escapes, so the
        values stay exact."""
        self.line(json_text(json.dumps(value, ensure_ascii=False)))

    def plain(self, text: str) -> str:
        """Return the text without a colour."""
        return text

    def red(self, text: str) -> str:
        """Return the text in red if the output shows colours."""
        return self._in(_RED, text)

    def green(self, text: str) -> str:
        """Return the text in green if the output shows colours."""
        return self._in(_GREEN, text)

    def yellow(self, text: str) -> str:
        """Return the text in yellow if the output shows colours."""
        return self._in(_YELLOW, text)

    def _in(self, colour: str, text: str) -> str:
        return f"{colour}{text}{_PLAIN}" if self._colours else text


def lead_nowhere(stream: TextIO) -> None:
    """Discard the unwritten text of a stream, so that the program does not wait for its reader."""
    with contextlib.suppress(OSError, ValueError, AttributeError):
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, stream.fileno())
        os.close(nowhere)


def note(text: str) -> None:
    """Write a note for people, as one line on standard error. It is lost if this is closed or
    full."""
    if sys.stderr is not None:
        with contextlib.suppress(OSError):
            print(one_line(text), file=sys.stderr, flush=True)


def note_losses(file: str) -> None:
    """Print a note before a file is replaced if it will lose its owner, its permissions or its
    other names."""
    from smsl_studio.smsl.traits import losses

    with contextlib.suppress(OSError):  # the save itself will report the error
        lost = losses(Path(os.path.realpath(file)))
        if lost:
            note(f"{file}: saved, it loses {', '.join(lost)}.")


def last_note(text: str) -> None:
    """Write the note of a stopped command. It is lost if standard error would block."""
    try:
        taken_in = select.select([], [sys.stderr.fileno()], [], 0.0)[1]
    except (OSError, ValueError, AttributeError):  # it is closed, or replaced in Python
        taken_in = [2]
    if taken_in:
        note(text)


def report_error(error: StudioError, name: str) -> None:
    """Print an expected error: its sentence with its place, then the advice, one line each.

    For a text that cannot be read, all faults are reported.
    """
    for one in error.faults if isinstance(error, ReadError) else (error,):
        note(str(one) if one.place else f"{name}: {one}")
        if one.advice:
            note(one.advice)


@contextlib.contextmanager
def claimed_stdout() -> Iterator[TextIO]:
    """Keep standard output for data. The printed output of other code goes to standard error.

    So the output of library code, and of C code, does not mix with the data. If standard output was
    already replaced in Python, the hosts separate the output themselves. If it is closed, the data
    is discarded.
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
    """Open file number 2 if standard error is closed, so that the data does not get this
    number."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    if nowhere != 2:
        os.dup2(nowhere, 2)
        os.close(nowhere)
