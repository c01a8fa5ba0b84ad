"""Forecasts beside a run at the speed of real time: ticks that begin late, stops, and the trace.

A run of Hanoi in physics is paced as the window does it, each tick at its time of the wall clock,
once alone and once with a twin that forecasts each operation before it begins, in a process of low
priority, over and over: that is harder than what the window does, which forecasts each of them
once. As there, a thread of this program asks for the forecasts and hears how far they are. A tick
is late if it begins more than 10 ms after its time. The pairs are run in turn, because a machine
changes its speed. Times are wall time: measure on a quiet machine.

The commands of the bench ``reaction`` are then given while a twin forecasts all the time. Last, the
events of a run with forecasts are compared with those of a run without, but for ``forecast``.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from queue import SimpleQueue

from benches.reaction import obeyed
from benches.row import Row
from smsl_studio import front
from smsl_studio.blueprint.address import Address
from smsl_studio.front.inputs import read
from smsl_studio.front.request import RunRequest
from smsl_studio.front.runs import open_request
from smsl_studio.front.twin_process import TwinProcess
from smsl_studio.runlog.events import ForecastTold
from smsl_studio.shipped import samples_dir
from smsl_studio.stop import Stopped, heeding

FILE, WORLD = "hanoi-corrected.json", "hanoi"
LATE = 0.010
"""Seconds after its time from which a tick is late."""
TICKS, ALL_TICKS = 1_000, 10_000
COMMANDS, ALL_COMMANDS = 100, 1_000

Asked = tuple[Mapping[str, str], Address]


def rows() -> Iterator[Row]:
    """Pace a tenth of the ticks, and give a tenth of the commands."""
    return _rows(TICKS, COMMANDS)


def all_rows() -> Iterator[Row]:
    """Measure all that is promised."""
    return _rows(ALL_TICKS, ALL_COMMANDS)


def _rows(ticks: int, commands: int) -> Iterator[Row]:
    late, begun = {False: 0, True: 0}, {False: 0, True: 0}
    while begun[True] < ticks:
        for foreseen in (False, True):
            made, tardy = _paced(foreseen)
            begun[foreseen] += made
            late[foreseen] += tardy
    yield Row(
        f"{begun[True]:,} ticks of {WORLD} at speed 1 with forecasts: begun over 10 ms late",
        late[True],
        "ticks",
        ((f"without, of {begun[False]:,}", late[False]),),
        "not more than without",
    )
    with _foreseeing() as queue:
        queue.put(({"SB1": "State_aaa"}, Address("SB1", "State_aaa", "Op_1c")))
        for row in obeyed(commands):
            yield Row(f"with forecasts meanwhile, {row.work}", row.ours, row.unit, bound=row.bound)
    blueprint = read(samples_dir() / FILE)
    told = front.run(blueprint, WORLD, forecast="show").events
    alone = front.run(blueprint, WORLD).events
    same = tuple(one for one in told if not isinstance(one, ForecastTold)) == alone
    yield Row("events of a run that differ with forecasts", int(not same), "", bound="0")


def _paced(foreseen: bool) -> tuple[int, int]:
    """Run once at speed 1. Return the number of ticks that move the world, and of the late ones."""
    request = RunRequest(read(samples_dir() / FILE), WORLD, host="process")
    dispatcher = open_request(request)
    made = tardy = 0
    with _foreseeing(foreseen) as queue:
        try:
            dispatcher.open()
            began, before = time.monotonic(), dispatcher.time
            asked: Asked | None = None
            while not dispatcher.finished:
                standing = dispatcher.standing.configuration
                following = dispatcher.status.route[:1] if dispatcher.under_way is None else ()
                wanted = (dict(standing), following[0]) if following else asked
                if wanted is not None and wanted != asked:
                    asked = wanted
                    queue.put(wanted)
                ahead = dispatcher.time - before - (time.monotonic() - began)
                if ahead > 0:
                    time.sleep(ahead)
                moved = dispatcher.time
                late = time.monotonic() - began - (moved - before)
                dispatcher.tick()
                if dispatcher.time > moved:
                    made += 1
                    tardy += late > LATE
                    if late > LATE:
                        # A late tick does not make those after it late.
                        began += late
        finally:
            dispatcher.close()
    return made, tardy


@contextmanager
def _foreseeing(on: bool = True) -> Iterator[SimpleQueue[Asked]]:
    """Give a queue. What is put there is forecast over and over, until the next comes. Without
    ``on`` nothing is.
    """
    queue: SimpleQueue[Asked] = SimpleQueue()
    over = threading.Event()
    thread = threading.Thread(target=_forecast, args=(queue, over))
    if on:
        thread.start()
    try:
        yield queue
    finally:
        over.set()
        if on:
            thread.join()


def _forecast(queue: SimpleQueue[Asked], over: threading.Event) -> None:
    request = RunRequest(read(samples_dir() / FILE), WORLD, host="process")
    twin = TwinProcess(request)

    def heed() -> None:
        """Stop a forecast when nobody wants it any more."""
        if over.is_set():
            raise Stopped

    asked: Asked | None = None
    try:
        with heeding(heed):
            while not over.is_set():
                asked = asked if queue.empty() else queue.get()
                if asked is None:
                    time.sleep(0.01)
                else:
                    twin.predict(*asked, lambda _, poses: None)
    except Stopped:
        pass
    finally:
        twin.close()
