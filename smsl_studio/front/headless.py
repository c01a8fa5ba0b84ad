"""The loop without a window: it ticks a dispatcher to the end of its run."""

from __future__ import annotations

import time
from collections.abc import Callable

from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.front.recorder import Recorder
from smsl_studio.front.script.player import ScriptPlayer
from smsl_studio.runlog.events import Event
from smsl_studio.stop import GRACE, Stopped, graceful

NAP = GRACE / 2
"""The longest wall time (s) that a paced run sleeps before it checks for a stop."""

BLINK = 1e-4
"""The shortest wall time (s) for which a paced run sleeps."""


class StopAsked:
    """Whether a run must stop, and whether it has obeyed already. The function ``when`` decides."""

    def __init__(self, when: Callable[[], bool] | None) -> None:
        self.obeyed = False
        self._when = when

    def __bool__(self) -> bool:
        return not self.obeyed and self._when is not None and self._when()

    def heed(self) -> None:
        """Raise Stopped if the run must stop and has not obeyed yet."""
        if self:
            raise Stopped


def to_its_end(
    dispatcher: Dispatcher,
    recording: Recorder,
    speed: float | None,
    asked: StopAsked,
    acting: ScriptPlayer | None,
) -> None:
    """Tick until the event ``run_finished``, paced by ``speed`` (see ``front.run``).

    After a stop is ``asked`` for, even during a long tick, the run brakes and ends. Stopped is
    raised if the world was not open yet.
    """

    def tell(events: tuple[Event, ...]) -> None:
        """Hand events to the recording, and to the script."""
        recording.tell(events)
        if acting is not None:
            acting.hear(events)

    tell(dispatcher.open())
    if dispatcher.opened is not None and dispatcher.opened.remote is not None:
        # Remote sensors send samples in wall time, so the run must not be faster.
        speed = min(speed or 1.0, 1.0)
    began = time.monotonic()
    with graceful():
        while not dispatcher.finished:
            if asked:
                asked.obeyed = True
                dispatcher.stop()
                dispatcher.leave()
            elif acting is not None and not asked.obeyed:
                acting.before(dispatcher)
            tell(dispatcher.tick())
            while speed is not None and not asked:
                ahead = dispatcher.time / speed - (time.monotonic() - began)
                if ahead < BLINK:
                    break
                time.sleep(min(ahead, NAP))
