"""A long day in one window: the memory that finished work leaves behind.

A state is added and undone, a run is made and closed, a window is opened and closed, again and
again. The memory of the process is read after a first share of each, and at the end; free memory of
the C library is given back before (``malloc_trim``). ``--all`` has 2,000 pairs of add and undo at
81 states, 60 runs and 40 windows; without it, a tenth.
"""

from __future__ import annotations

import ctypes
import gc
import os
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from benches.row import Row

if TYPE_CHECKING:
    from tests.sequences.seat import Seat

SAMPLES = Path(__file__).resolve().parents[1] / "samples"
PAIRS, RUNS, WINDOWS, TENTH = 2_000, 60, 40, 10
FIRST = 0.25
"""The share of the work after which memory is first read. Caches are full then."""
PATIENCE = 60.0
PAGE = os.sysconf("SC_PAGESIZE") / 1000
"""The size of one page of memory, in kB."""


def rows() -> Iterator[Row]:
    """Run a tenth of the day."""
    return _rows(TENTH)


def all_rows() -> Iterator[Row]:
    """Run the whole day."""
    return _rows(1)


def _rows(share: int) -> Iterator[Row]:
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    from smsl_studio.studio.shell.application import make_application
    from tests.sequences.seat import Seat

    application = make_application(["soak"])
    with tempfile.TemporaryDirectory() as name:
        seat = Seat(Path(name))
        text = (SAMPLES / "hanoi-4.json").read_text("utf-8")
        seat.open("hanoi-4.json", text)
        yield _row("a state of 81 added and undone", PAIRS // share, lambda: _pair(seat), "40")
        seat.open("hfsm.json", (SAMPLES / "hfsm.json").read_text("utf-8"))
        yield _row("a run of hfsm in a table world", RUNS // share, lambda: _run(seat), "1,000")
        seat.close()
        folders = iter(range(WINDOWS))
        yield _row(
            "a window on hanoi-4 opened and closed",
            WINDOWS // share,
            lambda: _window(Path(name) / str(next(folders)), text),
            "2,000",
        )
    application.processEvents()


def _row(work: str, times: int, act: Callable[[], None], bound: str) -> Row:
    """How many kB more there are for each time, from the first share on."""
    first = max(int(times * FIRST), 1)
    for _ in range(first):
        act()
    before = _kept()
    for _ in range(times - first):
        act()
    each = (_kept() - before) / (times - first)
    return Row(f"{work}, {times:,} times, kept of each", each, "kB", bound=f"less than {bound}")


def _pair(seat: Seat) -> None:
    seat.act("add_state")
    seat.write("State_soak")
    assert seat.window.session.history.count() == 1
    _until(lambda: seat.window.inspector.current)
    seat.act("undo")
    _until(lambda: seat.window.inspector.current)


def _run(seat: Seat) -> None:
    run = seat.window.features.run.pane.run
    seat.window.set_mode("run")
    seat.window.features.run.pane.play()
    _until(lambda: run.story.moment.finished is not None)
    assert run.phase == "goal_reached", run.phase
    run.close()
    seat.window.features.run.pane.show_drawing()


def _window(folder: Path, text: str) -> None:
    from tests.sequences.seat import Seat

    folder.mkdir()
    seat = Seat(folder)
    seat.open("hanoi-4.json", text)
    _until(lambda: seat.window.inspector.current)
    seat.close()


def _until(so: Callable[[], bool]) -> None:
    from PySide6.QtWidgets import QApplication

    end = time.monotonic() + PATIENCE
    while not so():
        QApplication.processEvents()
        time.sleep(0.001)
        if time.monotonic() > end:
            raise SystemExit("nothing has come of it")
    QApplication.processEvents()


def _kept() -> float:
    """kB of memory that the process has, without what it could give back."""
    from PySide6.QtCore import QEvent
    from PySide6.QtWidgets import QApplication

    QApplication.processEvents()
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    gc.collect()
    ctypes.CDLL(None).malloc_trim(0)
    return int(Path("/proc/self/statm").read_text().split()[1]) * PAGE
