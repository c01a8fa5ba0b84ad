"""Where a command writes: data to standard output, everything else to standard error."""

from __future__ import annotations

import contextlib
import json
import os
import sys
from collections.abc import Iterator
from typing import Any, TextIO
from unicodedata import category

from smsl_studio.errors import ReadError, SaveError, StudioError

_RED, _GREEN, _YELLOW, _PLAIN = "\x1b[31m", "\x1b[32m", "\x1b[33m", "\x1b[0m"


class Output:
    """The data of one command: lines of text, or JSON, one object a line."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream
        self._colours = stream.isatty() and not os.environ.get("NO_COLOR")

    def line(self, text: str) -> None:
        """One line, or several in one text; it is on its way when this returns."""
        self.text(f"{text}\n")

    def text(self, text: str) -> None:
        """A text as it is.

        SaveError where it cannot be written; BrokenPipeError where nobody reads it any more.
        """
        try:
            self._stream.write(text)
            self._stream.flush()
        except BrokenPipeError:
            raise
        except OSError as error:
            words = f"standard output cannot be written: {error.strerror or error}"
            raise SaveError(words, advice="Free some room, or send it elsewhere.") from None

    def json(self, value: Any) -> None:
        """One JSON object on a line of its own."""
        self.line(json.dumps(value, ensure_ascii=False))

    def plain(self, text: str) -> str:
        return text

    def red(self, text: str) -> str:
        return self._in(_RED, text)

    def green(self, text: str) -> str:
        return self._in(_GREEN, text)

    def yellow(self, text: str) -> str:
        return self._in(_YELLOW, text)

    def _in(self, colour: str, text: str) -> str:
        return f"{colour}{text}{_PLAIN}" if self._colours else text


def one_line(text: str) -> str:
    """A text for people with what would break its line, or turn it round, written as escapes."""
    if text.isprintable():
        return text
    return "".join(
        char if char.isprintable() or category(char) == "Zs" else _escaped(char) for char in text
    )


def _escaped(char: str) -> str:
    return char.encode("unicode_escape").decode("ascii")


def note(text: str) -> None:
    """A note for people, on standard error; lost where that is closed or full."""
    if sys.stderr is not None:
        with contextlib.suppress(OSError):
            print(text, file=sys.stderr, flush=True)


def report(error: StudioError, name: str) -> None:
    """An expected error: what is wrong with its place, then the advice, one line each.

    Of a text that cannot be read, every fault.
    """
    for one in error.faults if isinstance(error, ReadError) else (error,):
        note(one_line(str(one) if one.place else f"{name}: {one}"))
        if one.advice:
            note(one_line(one.advice))


@contextlib.contextmanager
def claimed_stdout() -> Iterator[TextIO]:
    """Standard output for us alone: what anyone else prints meanwhile goes to standard error.

    Library code, and the C code below it, may print what it likes; data stays whole. Where
    standard output was already replaced in Python, the hosts keep prints apart by themselves;
    where it is closed, the data goes nowhere.
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
    """Standard error is closed: keep its number from being given to our data."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    if nowhere != 2:
        os.dup2(nowhere, 2)
        os.close(nowhere)
