"""Waiting times in the window: an edit until the drawing is right, the wheel, a pan.

An edit is made as a key or a gesture makes it, and all Qt events that follow at once are done
before the clock stops: the drawing, the title and the source. What follows later (forms, lists,
enabled actions, findings, journal) has a row of its own. Frames of wheel and pan are painted before
the clock stops. Times are CPU time of the window's own thread; the row of later work counts all
threads.
"""

from __future__ import annotations

import os
import statistics
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

from benches.row import Row

SIZES = (3, 4, 6, 8)
FRAME = "at most 16 ms"
NOT_REACHED = {
    3: "at most 16 ms: not reached, because the copies of arrows are routed and named one by one",
    4: "at most 16 ms: not reached, because the names of so dense a picture depend on each other: "
    "where one moves, all are placed anew, or the picture would not be that of the opened file",
    6: "at most 16 ms: not reached, because model, index and text take a third of it, and the rest "
    "is spread over the routes, names and strokes of some hundred arrows near the change",
}
NOT_REACHED[8] = NOT_REACHED[6]
"""Promises of an edit by the number of disks, and why they are not kept. Measured by a profile."""
REST = "at most 150 ms"
SETTLED = "at most 200 ms"
KINDS = (
    "rename an operation",
    "rename a state",
    "add a state",
    "delete a state",
    "move a state",
    "connect two",
    "duplicate a state",
)


def rows() -> Iterator[Row]:
    """Milliseconds at 27, 81, 729 and 6,561 states."""
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    with tempfile.TemporaryDirectory() as folder:
        os.environ["SMSL_STUDIO_HOME"] = folder
        for disks in SIZES:
            yield from _rows(disks, Path(folder))


def _rows(disks: int, folder: Path) -> Iterator[Row]:
    from benches.window_sides import Seat

    seat = Seat(disks, folder)
    states = f"{3**disks:,} states"
    try:
        figure, rest = _edits(seat, seat.edits("move a state"))
        yield Row(f"{states}: the first move, which writes all places", figure, "ms", bound=SETTLED)
        seat.place_by_hand()
        for kind in KINDS:
            figure, rest = _edits(seat, seat.edits(kind))
            yield Row(f"{states}: {kind}", figure, "ms", bound=_promise(disks, kind))
            yield Row(f"{states}: {kind}, until all rests", rest, "ms", bound=REST)
        for words, near in (("fitted", False), ("at 100 %", True)):
            for way, turn in (("wheel", seat.zoom), ("pan", seat.pan)):
                seat.look(near)
                frames, rest = _frames(seat, turn)
                yield Row(f"{states}: {way}, {words}: the usual frame", statistics.median(frames))
                yield Row(f"{states}: {way}, {words}: the slowest", max(frames), bound=FRAME)
                yield Row(f"{states}: {way}, {words}: then rests in", rest, bound=SETTLED)
    finally:
        seat.close()


def _promise(disks: int, kind: str) -> str:
    kept = disks == 3 and kind != "duplicate a state"
    return FRAME if kept else NOT_REACHED[disks]


def _edits(seat: object, steps: Iterator[Callable[[], object]]) -> tuple[float, float]:
    """The median of an edit until the picture is right, and of all that follows."""
    from benches.window_sides import Seat

    assert isinstance(seat, Seat)
    shown, rests = [], []
    for step in steps:
        seat.rest()
        start, whole = time.thread_time(), time.process_time()
        step()
        seat.paint()
        shown.append((time.thread_time() - start) * 1000)
        seat.rest()
        rests.append((time.process_time() - whole) * 1000)
    return statistics.median(shown), statistics.median(rests)


def _frames(seat: object, turn: Callable[[int], object]) -> tuple[list[float], float]:
    """Each of twelve frames, and what is left to do after the last one."""
    from benches.window_sides import Seat

    assert isinstance(seat, Seat)
    frames = []
    for step in range(12):
        start = time.thread_time()
        turn(1 if step < 6 else -1)
        seat.paint()
        frames.append((time.thread_time() - start) * 1000)
    start = time.thread_time()
    seat.rest()
    return frames, (time.thread_time() - start) * 1000
