"""Watches what generated code asks of the system while it runs, by Python's audit events.

An event stops the code at once. An ``except`` in it changes nothing: what was reached for is kept,
and told when the code next gives the turn back.
"""

from __future__ import annotations

import inspect
import sys
from collections.abc import Callable, Generator
from types import FrameType
from typing import Any

_HARMLESS = (
    "object.", "sys._getframe", "sys._current_frames", "builtins.id", "array.", "gc.",
    "sys.unraisablehook", "sys.excepthook", "code.", "import",
)  # fmt: skip
_IMPORTS = "<frozen importlib._bootstrap>"
_WORDS = {
    "open": "it opens a file",
    "os": "it asks the system",
    "shutil": "it moves files",
    "socket": "it asks the network",
    "subprocess": "it starts a process",
    "exec": "it makes code of a text",
    "compile": "it makes code of a text",
    "_thread": "it starts a thread",
    "ctypes": "it reaches into memory",
}


class ReachedOut(Exception):  # noqa: N818
    """Generated code has asked for something outside of its world."""


class _CodeWatch:
    """The one watch of a process. ``on`` while generated code has the turn."""

    def __init__(self) -> None:
        self.on = False
        self.reached = ""
        self.hooked = False

    def begin(self) -> None:
        """Give the turn to generated code."""
        if not self.hooked:
            sys.addaudithook(self.heard)
            self.hooked = True
        self.on = True

    def end(self) -> None:
        """Take the turn back. ReachedOut if the code has reached out, now or before."""
        self.on = False
        if self.reached:
            raise ReachedOut(self.reached)

    def heard(self, event: str, arguments: tuple[object, ...]) -> None:
        """Refuse an event while generated code has the turn."""
        if not self.on or event.startswith(_HARMLESS) or _is_import():
            return
        what = str(arguments[0])[:100] if arguments and type(arguments[0]) in (str, bytes) else ""
        words = _WORDS.get(event.partition(".")[0], "it reaches out of its world")
        self.reached = self.reached or f"{words} ({event}{f' {what}' if what else ''})"
        raise ReachedOut(self.reached)


def _is_import() -> bool:
    """Whether a library loads a part of itself. Generated code has no way to import anything."""
    frame: FrameType | None = sys._getframe(2)
    while frame is not None and frame.f_code.co_filename != __file__:
        if frame.f_code.co_filename == _IMPORTS:
            return True
        frame = frame.f_back
    return False


_WATCH = _CodeWatch()
Steps = Generator[Any, Any, Any]


def watched(begin: Callable[[], Steps]) -> Steps:
    """Run generated code tick by tick under the watch. ReachedOut if it reaches out."""
    _WATCH.reached = ""
    steps = begin()
    try:
        while True:
            _WATCH.begin()
            try:
                next(steps)
            except StopIteration as end:
                told = end.value
                break
            finally:
                _WATCH.end()
            yield
    finally:
        _close(steps)
    return told if told is False or type(told) is str else None


_UNENDING: list[Steps] = []
"""Code that goes on where it is told to end. It is kept: Python would tell it to end again, not
watched, and print a traceback."""


def _close(steps: Steps) -> None:
    """Tell the code to end. RuntimeError, in one sentence, if it goes on."""
    _WATCH.on = True
    try:
        steps.close()
    except RuntimeError:
        if inspect.getgeneratorstate(steps) == inspect.GEN_CLOSED:
            raise
        _UNENDING.append(steps)
        raise RuntimeError("the code goes on where it is told to end") from None
    finally:
        _WATCH.on = False


def trusted(steps: Steps) -> Steps:
    """Run code of a plugin that generated code has called. It is not watched."""
    while True:
        was, _WATCH.on = _WATCH.on, False
        try:
            next(steps)
        except StopIteration as end:
            return end.value
        finally:
            _WATCH.on = was
        yield
