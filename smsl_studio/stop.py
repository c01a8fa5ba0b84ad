"""A stop: how long work is ended early, and what it may leave undone.

Work is called off by an exception, ``Stopped``, on one of two ways:

- ``heed`` stands in the loops that may last. It asks whoever listens in this thread (``heeding``),
  and that one raises ``Stopped`` where the work is no longer wanted. Work that is ``restartable``
  may be called off for less than a stop: asked for again, it does what was left to do.
- A signal of the command line raises ``BrokenOff`` in the main thread, at whatever it is. What was
  going on there counts for nothing afterwards.

Two kinds of work are left alone by signals: what must be ``whole`` (a file that is being saved, a
log that gets its end) and, for ``GRACE`` seconds, what is ``graceful`` (it heeds by itself).

Python's search for garbage hears nothing either: with ten million objects it takes seconds. So
commands do without it (``let_garbage_be``) until a run begins (``look_for_garbage``).
"""

from __future__ import annotations

import gc
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

GRACE = 0.1
"""Wall seconds in which graceful work must have heeded a signal before it is broken off."""

LONGEST = 40
"""How many looks more somebody gets for an answer while the machine gives it no time to work."""

Listener = Callable[[], object]


def _nobody() -> None:
    """The listener that never stops anything."""


class Stopped(KeyboardInterrupt):
    """The work is to stop. Like Ctrl-C it passes code that catches errors."""


class BrokenOff(Stopped):
    """A stop that is raised at any place: the work there may be half done."""


class _Thread(threading.local):
    """The work of one thread, as far as a stop is concerned."""

    listener: Listener | None = None
    whole = 0
    graceful = 0
    restartable = 0
    starving = False


_thread = _Thread()


class StopListener:
    """A listener that calls the work off when it is asked for the ``last`` time.

    Asked in ``starving`` work it waits, ``most`` times at most: on a machine that is busy, who has
    had no time to answer is not mute.
    """

    def __init__(self, last: int, most: int = 0) -> None:
        self._left, self._starving = last, most

    def heed(self) -> None:
        """Raise Stopped once it has been asked often enough."""
        if _thread.starving and self._starving > 0:
            self._starving -= 1
            return
        self._left -= 1
        if self._left <= 0:
            raise Stopped


def heed() -> None:
    """Raise ``Stopped`` where the listener of this thread wants the work to stop."""
    listener = _thread.listener
    if listener is not None and not _thread.whole:
        listener()


@contextmanager
def heeding(listener: Listener) -> Iterator[None]:
    """While it lasts, ``heed`` in this thread asks ``listener``, in the place of who listened.

    ``listener`` raises ``Stopped`` where the work is no longer wanted.
    """
    before, _thread.listener = _thread.listener, listener
    try:
        yield
    finally:
        _thread.listener = before


@contextmanager
def unheeding() -> Iterator[None]:
    """While it lasts, nobody is asked in this thread: what ends the work is itself wanted."""
    with heeding(_nobody):
        yield


@contextmanager
def whole() -> Iterator[None]:
    """While it lasts, nothing calls this thread's work off; a stop is heeded at its end, unless
    the work is graceful and heeds by itself."""
    _thread.whole += 1
    try:
        yield
    finally:
        _thread.whole -= 1
    if not _thread.graceful:
        heed()


@contextmanager
def graceful() -> Iterator[None]:
    """While it lasts, a signal waits ``GRACE`` seconds for this thread to heed it."""
    _thread.graceful += 1
    try:
        yield
    finally:
        _thread.graceful -= 1


class Restartable:
    """While it lasts, what is called off has changed nothing, and may be asked for again."""

    __slots__ = ()

    def __enter__(self) -> None:
        _thread.restartable += 1

    def __exit__(self, *_: object) -> None:
        _thread.restartable -= 1


_RESTARTABLE = Restartable()


def restartable() -> Restartable:
    """What to enter for such work; a run asks for it at every proposal."""
    return _RESTARTABLE


@contextmanager
def starving(is_so: bool) -> Iterator[None]:
    """While it lasts, who is waited for has been given no time by the machine, if it ``is_so``."""
    _thread.starving = is_so
    try:
        yield
    finally:
        _thread.starving = False


def is_whole() -> bool:
    """Whether this thread is at something that must be whole."""
    return _thread.whole > 0


def is_graceful() -> bool:
    """Whether this thread heeds by itself."""
    return _thread.graceful > 0


def is_restartable() -> bool:
    """Whether what this thread is at may be called off and asked for again."""
    return _thread.restartable > 0


def let_garbage_be() -> None:
    """Look for no garbage in circles from now on; what nobody refers to is freed all the same."""
    gc.disable()


def look_for_garbage() -> None:
    """Look for it again, but not among what there is by now; nothing where it was never let be."""
    if not gc.isenabled():
        gc.freeze()
        gc.enable()
