"""A stop ends work early.

Work is called off by the exception ``Stopped``, in one of two ways:

- Loops that may last call ``heed``. It asks the listener of this thread (see ``heeding``), which
  raises ``Stopped`` if the work is no longer wanted. Work that is ``restartable`` may also be
  called off for smaller reasons. It keeps its results, so a later call does only the rest.
- A signal of the command line raises ``BrokenOff`` in the main thread, at any line. The results of
  the interrupted work are not used.

A signal does not interrupt two kinds of work: ``whole`` work, such as saving a file or ending a
log, and, for ``GRACE`` seconds, ``graceful`` work, which calls ``heed`` itself. Python's garbage
collection cannot be interrupted either, and with ten million objects it takes seconds. So commands
switch it off (``let_garbage_be``) until a run or a proof begins. Then it is on
(``look_for_garbage``), and never looks at very many objects again.

Who asks may also bound the time and the memory of work (``bounded``). Then the work heeds the bound
where it heeds a stop, and BoundMet says which one was met.
"""

from __future__ import annotations

import gc
import threading
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from time import monotonic
from typing import NamedTuple

GRACE = 0.1
"""The wall time (s) that graceful work has to heed a signal before it is broken off."""

LONG = 0.05
"""The longest collection of garbage that is accepted, in seconds of wall time. A signal has to wait
until a collection ends."""
OLDEST = 2
"""The number of the garbage collector's generation in which a collection looks at all objects."""

LONGEST = 40
"""The number of further checks that wait for an answer while the machine gives the other process no
processor time."""

Listener = Callable[[], object]


def _nobody() -> None:
    """The listener that never stops anything."""


class Stopped(KeyboardInterrupt):
    """The work must stop. It is a KeyboardInterrupt, so code that catches errors does not catch
    it."""


class BrokenOff(Stopped):
    """A stop that is raised at any line, so the interrupted work may be half done."""


class _Thread(threading.local):
    """The state of one thread that matters for a stop."""

    listener: Listener | None = None
    whole = 0
    graceful = 0
    restartable = 0
    starving = False


_thread = _Thread()


class StopListener:
    """A listener that calls the work off when it is asked for the ``last`` time.

    Calls in ``starving`` work do not count, at most ``most`` times: a process without processor
    time cannot answer.
    """

    def __init__(self, last: int, most: int = 0) -> None:
        self._left, self._starving = last, most

    def heed(self) -> None:
        """Raise Stopped at the last of the allowed calls."""
        if _thread.starving and self._starving > 0:
            self._starving -= 1
            return
        self._left -= 1
        if self._left <= 0:
            raise Stopped


def heed() -> None:
    """Raise ``Stopped`` if the listener of this thread wants the work to stop."""
    listener = _thread.listener
    if listener is not None and not _thread.whole:
        listener()


@contextmanager
def heeding(listener: Listener) -> Iterator[None]:
    """Inside the block, ``heed`` in this thread asks ``listener`` instead of the listener before.

    ``listener`` raises ``Stopped`` if the work is no longer wanted.
    """
    before, _thread.listener = _thread.listener, listener
    try:
        yield
    finally:
        _thread.listener = before


@contextmanager
def unheeding() -> Iterator[None]:
    """Inside the block, ``heed`` in this thread never raises. It is for the steps that end the
    work."""
    with heeding(_nobody):
        yield


@contextmanager
def whole() -> Iterator[None]:
    """Inside the block, no stop interrupts this thread's work. A stop is heeded at its end, unless
    the work is graceful and calls ``heed`` itself."""
    _thread.whole += 1
    try:
        yield
    finally:
        _thread.whole -= 1
    if not _thread.graceful:
        heed()


@contextmanager
def graceful() -> Iterator[None]:
    """Inside the block, a signal waits ``GRACE`` seconds for this thread to heed it."""
    _thread.graceful += 1
    try:
        yield
    finally:
        _thread.graceful -= 1


class Restartable:
    """Inside the block, work that is called off leaves no change and may be called again."""

    __slots__ = ()

    def __enter__(self) -> None:
        _thread.restartable += 1

    def __exit__(self, *_: object) -> None:
        _thread.restartable -= 1


_RESTARTABLE = Restartable()


def restartable() -> Restartable:
    """Return the context of such work. It is one object, because a run enters it at every
    proposal."""
    return _RESTARTABLE


@contextmanager
def starving(is_so: bool) -> Iterator[None]:
    """Inside the block, the process that this thread waits for had no processor time, if
    ``is_so``."""
    _thread.starving = is_so
    try:
        yield
    finally:
        _thread.starving = False


def is_whole() -> bool:
    """Whether this thread does work that must be whole."""
    return _thread.whole > 0


def is_graceful() -> bool:
    """Whether this thread does graceful work, which calls ``heed`` itself."""
    return _thread.graceful > 0


def is_restartable() -> bool:
    """Whether this thread does work that may be called off and called again."""
    return _thread.restartable > 0


def let_garbage_be() -> None:
    """Switch the collection of reference cycles off. Other objects are freed as before."""
    gc.disable()


def look_for_garbage() -> None:
    """Switch the garbage collection on again, for objects that are made from now on.

    Nothing happens if it is on already. Work that stores millions of objects would make each
    collection long. So once a collection was long, later ones skip the objects that exist now (see
    ``spare_the_old``).
    """
    if not gc.isenabled():
        gc.freeze()
        if spare_the_old not in gc.callbacks:
            gc.callbacks.append(spare_the_old)
        gc.enable()


def spare_the_old(phase: str, info: Mapping[str, int]) -> None:
    """After a collection longer than ``LONG``, let later ones skip the objects that are left.

    So the next collection is short. Python calls this function at the beginning and at the end of
    each collection, and ``phase`` says which.
    """
    if info["generation"] < OLDEST:
        return
    if phase == "start":
        _collection.began = monotonic()
    elif monotonic() - _collection.began > LONG:
        gc.freeze()


class _Collection:
    """The present collection of garbage: when it began, in seconds of wall time."""

    began = 0.0


_collection = _Collection()


# bounds that a caller sets ----------------------------------------------------------------------

_OFTEN = 0.02
"""The seconds between two measurements of memory."""

_STATM = Path("/proc/self/statm")


class BoundMet(Exception):  # noqa: N818 -- an answer, not an error of ours
    """The work has met a bound. The text of the error names the bound."""


class EffortBounds(NamedTuple):
    """How much one piece of work may take. None means that there is no bound.

    ``seconds`` is wall time. ``megabytes`` (MB) is the memory of this whole process. ``until`` is
    the moment at which the time ends (see ``monotonic``); it is None until the time begins.
    """

    seconds: float | None = None
    megabytes: int | None = None
    until: float | None = None

    def begun(self) -> EffortBounds:
        """Return the same bounds with their time running.

        Time that already runs is not begun again.
        """
        if self.seconds is None or self.until is not None:
            return self
        return self._replace(until=monotonic() + self.seconds)


UNBOUNDED = EffortBounds()


@contextmanager
def bounded(bounds: EffortBounds) -> Iterator[None]:
    """Let every call of ``heed`` inside the block raise BoundMet as soon as a bound is met."""
    if bounds == UNBOUNDED:
        yield
        return
    most, until = bounds.megabytes, bounds.begun().until
    before, looked = _thread.listener or _nobody, 0.0

    def heed_all() -> None:
        """Check whether the work must end.

        Call the listener that was set outside of the block. Then compare the clock with the bound
        of time. Every ``_OFTEN`` seconds compare the memory with its bound, because a measurement
        is slow.
        """
        nonlocal looked
        before()
        now = monotonic()
        if until is not None and now > until:
            raise BoundMet(f"{bounds.seconds:g} seconds")
        if most is not None and now - looked > _OFTEN:
            if megabytes() > most:
                raise BoundMet(f"{most:,} MB of memory")
            looked = now

    with heeding(heed_all):
        yield


def megabytes() -> float:
    """Return the memory that this process uses now, in MB.

    Some systems do not tell this. There it is the largest amount that the process has used so far.
    """
    try:
        pages = int(_STATM.read_text("ascii").split()[1])
    except OSError:
        import resource

        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    return pages * 4096 / 1e6
