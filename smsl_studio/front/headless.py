"""The headless loop: a dispatcher ticked to the end of its run."""

from __future__ import annotations

import time
from collections.abc import Callable

from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.front.recording import Recording
from smsl_studio.front.script.acting import Acting
from smsl_studio.runlog.events import Event

NAP = 0.1
"""The longest (wall seconds) a paced run sleeps before it looks whether it shall stop."""

BLINK = 1e-4
"""What is left of a pause (wall seconds) that is not worth sleeping for."""


def to_its_end(
    dispatcher: Dispatcher,
    recording: Recording,
    speed: float | None,
    stop_when: Callable[[], bool] | None,
    acting: Acting | None,
) -> None:
    """Tick until ``run_finished`` is told, paced by ``speed`` (see ``front.run``).

    ``stop_when`` is asked before every tick: a stop ends the run where it brakes.
    """
    stopping = False

    def asked() -> bool:
        return stop_when is not None and stop_when()

    def tell(events: tuple[Event, ...]) -> None:
        recording.tell(events)
        if acting is not None:
            acting.hear(events)

    tell(dispatcher.open())
    if dispatcher.opened is not None and dispatcher.opened.remote is not None:
        # Sensors elsewhere speak in wall time, and have to be waited for.
        speed = min(speed or 1.0, 1.0)
    began = time.monotonic()
    while not dispatcher.finished:
        if not stopping and asked():
            dispatcher.stop()
            dispatcher.leave()
            stopping = True
        elif acting is not None and not stopping:
            acting.before(dispatcher)
        tell(dispatcher.tick())
        while speed is not None and not asked():
            ahead = dispatcher.time / speed - (time.monotonic() - began)
            if ahead < BLINK:
                break
            time.sleep(min(ahead, NAP))
