"""Work in a second thread, so that the window does not freeze; one task after the other.

Qt crashes if an object of its own is freed in another thread than its own, and Python frees an
object where its last reference is given up. So the window's thread keeps all that a task holds
until the worker thread has let go of it, also when the window is closed in the meantime. The worker
touches no object of Qt and emits no signal: the window's thread looks whether a task is done, and
at the ``Tally`` of a task that counts.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor, wait
from typing import Any, TypeVar

from PySide6.QtCore import QCoreApplication, QObject, QTimer

from smsl_studio.stop import Stopped, heeding

Came = TypeVar("Came")

LOOK = 2
"""Milliseconds between two looks at a task that is being done."""


class Tally:
    """A number that the worker thread counts up, and the window's thread reads."""

    count = 0

    def tell(self, count: int) -> None:
        """Hear the number."""
        self.count = count


class Beside(QObject):
    """One worker thread with a queue. Results arrive in the thread of this object."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._thread = ThreadPoolExecutor(1)
        self._tasks = tasks = _Tasks()
        self._stopped = False
        # The tasks outlive this object, so the function does not hold it.
        self.destroyed.connect(lambda: tasks.forget())

    def do(self, work: Callable[[], Came], then: Callable[[Came], object]) -> None:
        """Queue ``work`` for the worker thread; ``then`` gets its result in this thread.

        An exception from ``work`` is raised again in this thread, where unsaved work is kept.
        """
        if not self._stopped:
            task = _Task(work, then, self._tasks.wanted)
            self._tasks.add(task, self._thread.submit(task.do))

    def drop(self) -> None:
        """Give up all tasks so far: none of their results is handed over, also of a task that is
        already done. The running task is called off if it heeds that (see ``stop.heed``).
        """
        self._tasks.drop()

    def wait(self) -> None:
        """Wait until all tasks are done. Their results are handed over later."""
        self._tasks.wait()

    def stop(self) -> None:
        """Hand over no further results and do not wait.

        The running task is called off if it heeds that. Otherwise it ends by itself.
        """
        self._stopped = True
        self._tasks.forget()
        self._thread.shutdown(wait=False, cancel_futures=True)


class _Wanted:
    """A flag between the threads: whether the result of a task is still wanted."""

    def __init__(self) -> None:
        self.ends = False

    def heed(self) -> None:
        """Raise ``Stopped`` if the result is no longer wanted."""
        if self.ends:
            raise Stopped


class _Task:
    """One task. The worker thread fills in what came, the window's thread empties the task."""

    def __init__(
        self, work: Callable[[], Any], then: Callable[[Any], object], wanted: _Wanted
    ) -> None:
        self._work: Callable[[], Any] | None = work
        self._then: Callable[[Any], object] | None = then
        self._wanted = wanted
        self._came: Any = None
        self._error: Exception | None = None
        self._called_off = False

    def do(self) -> None:
        """Do the work, in the worker thread."""
        assert self._work is not None
        try:
            with heeding(self._wanted.heed):
                self._came = self._work()
        except Stopped:
            self._called_off = True
        except Exception as error:
            self._error = error

    def empty(self) -> Callable[[], object]:
        """Take out all that the task holds. The returned function hands over what came."""
        then, came, error = self._then, self._came, self._error
        called_off, wanted = self._called_off, self._wanted
        self._work = self._then = self._came = self._error = None

        def hand_over() -> None:
            """Give the result to who asked for it, or raise the error of the work."""
            if error is not None:
                raise error
            if then is not None and not called_off and not wanted.ends:
                then(came)

        return hand_over


class _Tasks:
    """The tasks of one worker thread that were not handed over yet, the oldest first."""

    def __init__(self) -> None:
        self.wanted = _Wanted()
        self._tasks: deque[tuple[_Task, Future[None]]] = deque()
        self._timer: QTimer | None = None
        self._forgotten = False

    def add(self, task: _Task, future: Future[None]) -> None:
        """Add a task that was given to the worker thread."""
        self._tasks.append((task, future))
        if self._timer is None:
            # A child of the application, because the tasks may outlive the window.
            self._timer = QTimer(QCoreApplication.instance())
            self._timer.setSingleShot(True)
            self._timer.timeout.connect(lambda: self._look())
            self._timer.start(LOOK)

    def wait(self) -> None:
        """Wait until all tasks are done."""
        wait([future for _, future in self._tasks])
        if self._timer is not None:
            self._timer.start(0)

    def drop(self) -> None:
        """Give up all tasks so far."""
        self.wanted.ends = True
        self.wanted = _Wanted()
        for one in tuple(self._tasks):
            task, future = one
            if future.cancel():
                self._tasks.remove(one)
                task.empty()

    def forget(self) -> None:
        """Hand over no further results."""
        self._forgotten = True
        self.drop()

    def _look(self) -> None:
        """Hand over the results of the tasks that are done."""
        while self._tasks and self._tasks[0][1].done():
            task, _ = self._tasks.popleft()
            hand_over = task.empty()
            # Before the result is handed over, because that may open a dialog and wait for it.
            self._look_again()
            if not self._forgotten:
                hand_over()
        self._look_again()

    def _look_again(self) -> None:
        if self._timer is None:
            return
        if self._tasks:
            self._timer.start(LOOK)
        else:
            self._timer.deleteLater()
            self._timer = None
