"""Work on the worker thread: done in order, results handed over to this thread, nothing kept."""

from __future__ import annotations

import gc
import threading
import weakref
from collections.abc import Callable, Iterator
from functools import partial

import pytest
from PySide6.QtCore import QEvent, QEventLoop, QObject
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from smsl_studio.stop import heed
from smsl_studio.studio.base.beside import Beside


class Thing:
    """Something that work can hold."""


@pytest.fixture
def beside(qapp: QApplication) -> Iterator[Beside]:
    parent = QObject()
    made = Beside(parent)
    yield made
    made.stop()


def test_work_is_done_on_another_thread_and_results_come_back_in_order(
    beside: Beside, qtbot: QtBot
) -> None:
    here, came = threading.get_ident(), []

    def then(number: int, there: int) -> None:
        came.append((number, there != here, threading.get_ident() == here))

    for number in range(3):
        beside.do(threading.get_ident, partial(then, number))
    qtbot.waitUntil(lambda: len(came) == 3)
    assert came == [(number, True, True) for number in range(3)]


@pytest.mark.parametrize("end", [Beside.drop, Beside.stop])
def test_work_that_checks_for_it_can_be_cancelled(
    beside: Beside, qtbot: QtBot, end: Callable[[Beside], None]
) -> None:
    going, ended, came = threading.Event(), threading.Event(), list[str]()

    def work() -> str:
        try:
            going.set()
            while True:
                heed()
        finally:
            ended.set()

    beside.do(work, came.append)
    going.wait()
    end(beside)
    qtbot.waitUntil(ended.is_set)
    beside.do(lambda: "next", came.append)
    qtbot.waitUntil(lambda: came == ([] if end is Beside.stop else ["next"]))


def test_what_is_running_or_waits_can_be_dropped(beside: Beside, qtbot: QtBot) -> None:
    going, go = threading.Event(), threading.Event()
    came: list[str] = []

    def first() -> str:
        going.set()
        go.wait()
        return "first"

    beside.do(first, came.append)
    going.wait()
    beside.do(lambda: "dropped", came.append)
    beside.drop()
    beside.do(lambda: "last", came.append)
    go.set()
    qtbot.waitUntil(lambda: came == ["last"])


def test_what_is_done_can_still_be_dropped(beside: Beside, qtbot: QtBot) -> None:
    """A dialog showed the former choice: its result came after the next one was asked for."""
    came: list[str] = []
    beside.do(lambda: "former", came.append)
    beside.wait()
    beside.drop()
    beside.do(lambda: "next", came.append)
    qtbot.waitUntil(lambda: came == ["next"])


def test_after_the_end_nothing_is_handed_over(beside: Beside, qapp: QApplication) -> None:
    came: list[int] = []
    beside.do(lambda: 1, came.append)
    beside.wait()
    beside.stop()
    beside.do(lambda: 2, came.append)
    qapp.processEvents()
    assert came == []


def test_the_end_waits_for_nobody(beside: Beside, qapp: QApplication) -> None:
    going, go = threading.Event(), threading.Event()
    came: list[bool] = []

    def work() -> bool:
        going.set()
        return go.wait()

    beside.do(work, came.append)
    going.wait()
    beside.stop()
    go.set()
    beside.wait()
    qapp.processEvents()
    assert came == []


def test_a_fault_is_raised_where_the_work_was_asked_for(beside: Beside, qtbot: QtBot) -> None:
    with qtbot.captureExceptions() as caught:
        beside.do(partial(int, "seven"), print)
        qtbot.waitUntil(lambda: bool(caught))
    assert [kind for kind, *_ in caught] == [ValueError]
    caught.clear()


def test_done_or_dropped_work_is_freed(beside: Beside, qapp: QApplication) -> None:
    held = []
    for number in range(300):
        thing = Thing()
        held.append(weakref.ref(thing))

        def show(_: int, thing: Thing = thing) -> None:
            """Holds what it would show."""

        beside.do(partial(id, thing), show)
        del thing, show
        if number % 7 == 0:
            beside.drop()
    beside.wait()
    qapp.processEvents()
    beside.drop()
    beside.do(int, print)
    beside.wait()
    gc.collect()
    assert [ref for ref in held if ref() is not None] == []


@pytest.mark.parametrize("end", [Beside.drop, Beside.stop, Beside.parent, None])
def test_what_a_task_holds_is_freed_in_this_thread(
    qapp: QApplication, qtbot: QtBot, end: Callable[[Beside], object] | None
) -> None:
    """Qt crashes if a widget is freed in another thread."""
    parent = QObject()
    beside = Beside(parent)
    going, go = threading.Event(), threading.Event()
    ends: list[tuple[str, bool]] = []
    here = threading.get_ident()
    things = Thing(), Thing()

    def freed(name: str) -> None:
        ends.append((name, threading.get_ident() == here))

    for name, thing in zip(("work", "then"), things, strict=True):
        weakref.finalize(thing, freed, name)

    def work(held: Thing) -> bool:
        going.set()
        return go.wait() and held is not None

    def then(held: Thing, came: bool) -> None:
        assert held is not None
        assert came

    beside.do(partial(work, things[0]), partial(then, things[1]))
    del things, thing
    going.wait()
    if end is None:
        del beside
        parent.deleteLater()
        qapp.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    else:
        end(beside)
    go.set()
    qtbot.waitUntil(lambda: len(ends) == 2)
    assert sorted(ends) == [("then", True), ("work", True)]


def test_results_come_also_while_a_dialog_of_the_result_before_is_open(
    beside: Beside, qtbot: QtBot
) -> None:
    came: list[str] = []
    dialog = QEventLoop()

    def open_dialog(words: str) -> None:
        came.append(words)
        dialog.exec()
        came.append("closed")

    def close_dialog(words: str) -> None:
        came.append(words)
        dialog.quit()

    beside.do(lambda: "first", open_dialog)
    beside.do(lambda: "second", close_dialog)
    qtbot.waitUntil(lambda: len(came) == 3)
    assert came == ["first", "second", "closed"]
