"""Work beside the window's own thread, so that nobody waits for it; one piece after the other."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor, wait
from typing import TypeVar

from PySide6.QtCore import QObject, Signal

from smsl_studio.stop import Stopped, heeding

Came = TypeVar("Came")


class Beside(QObject):
    """A thread that does one piece of work at a time, and hands over what came of it here.

    It is Python's own: a task of Qt's pool that is done before Qt has taken it over is kept for
    ever, with all that it holds.
    """

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._thread = ThreadPoolExecutor(1)
        self._waiting: list[Future[None]] = []
        self._wanted = _Wanted()
        self._stopped = False
        # Without a parent: work that outlives this object still has somebody to tell.
        self._told = _Result()
        self._told.done.connect(self._hand_over)
        self._told.failed.connect(self._failed)

    def do(self, work: Callable[[], Came], then: Callable[[Came], object]) -> None:
        """Do ``work`` there after what waits already; ``then`` gets what came of it, here.

        What ``work`` raises is raised here, where the person's work is kept.
        """
        if self._stopped:
            return
        self._waiting = [one for one in self._waiting if not one.done()]
        self._waiting.append(self._thread.submit(_do, work, then, self._told, self._wanted))

    def drop(self) -> None:
        """Forget what has not begun, and call off what is being done, where that heeds it (see
        ``stop.heed``)."""
        self._wanted.ends = True
        self._wanted = _Wanted()
        for one in self._waiting:
            one.cancel()

    def wait(self) -> None:
        """Return when all is done; what came of it is handed over later."""
        wait(self._waiting)

    def stop(self) -> None:
        """Hand nothing over any more. What is being done is called off where that heeds it, and
        else ends by itself; nobody waits for it."""
        self._stopped = self._wanted.ends = True
        self._thread.shutdown(wait=False, cancel_futures=True)

    def _hand_over(self, then: Callable[[Came], object], came: Came) -> None:
        if not self._stopped:
            then(came)

    def _failed(self, error: Exception) -> None:
        raise error


class _Result(QObject):
    done = Signal(object, object)
    failed = Signal(object)


class _Wanted:
    """Whether a piece of work is wanted; set by one thread, asked by another."""

    def __init__(self) -> None:
        self.ends = False

    def heed(self) -> None:
        """Raise ``Stopped`` where the work is wanted no more."""
        if self.ends:
            raise Stopped


def _do(
    work: Callable[[], Came], then: Callable[[Came], object], told: _Result, wanted: _Wanted
) -> None:
    try:
        with heeding(wanted.heed):
            came = work()
    except Stopped:
        return
    except Exception as error:
        told.failed.emit(error)
    else:
        told.done.emit(then, came)
