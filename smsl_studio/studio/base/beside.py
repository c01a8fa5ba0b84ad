"""Work in a second thread, so that the window does not freeze; one task after the other."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor, wait
from typing import TypeVar

from PySide6.QtCore import QObject, Signal

from smsl_studio.stop import Stopped, heeding

Came = TypeVar("Came")


class Beside(QObject):
    """One worker thread with a queue. Results arrive in the thread of this object.

    It does not use Qt's thread pool: if a task of that pool ends before Qt has taken it over, it is
    never freed, nor what it holds.
    """

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._thread = ThreadPoolExecutor(1)
        self._waiting: list[Future[None]] = []
        self._wanted = _Wanted()
        self._stopped = False
        # No parent, because a task that outlives this object still emits its signals.
        self._told = _Result()
        self._told.done.connect(self._hand_over)
        self._told.failed.connect(self._failed)

    def do(self, work: Callable[[], Came], then: Callable[[Came], object]) -> None:
        """Queue ``work`` for the worker thread; ``then`` gets its result in this thread.

        An exception from ``work`` is raised again in this thread, where unsaved work is kept.
        """
        if self._stopped:
            return
        self._waiting = [one for one in self._waiting if not one.done()]
        self._waiting.append(self._thread.submit(_do, work, then, self._told, self._wanted))

    def drop(self) -> None:
        """Cancel what has not begun, and call off the running task if it heeds that (see
        ``stop.heed``)."""
        self._wanted.ends = True
        self._wanted = _Wanted()
        for one in self._waiting:
            one.cancel()

    def wait(self) -> None:
        """Wait until all tasks are done. Their results are handed over later."""
        wait(self._waiting)

    def stop(self) -> None:
        """Hand over no further results and do not wait.

        The running task is called off if it heeds that. Otherwise it ends by itself.
        """
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
    """A flag between the threads: whether the result of a task is still wanted."""

    def __init__(self) -> None:
        self.ends = False

    def heed(self) -> None:
        """Raise ``Stopped`` if the result is no longer wanted."""
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
