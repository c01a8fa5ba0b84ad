"""The headless loop: a dispatcher ticked to the end of its run."""

from __future__ import annotations

import time
from collections.abc import Callable

from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.front.recorder import Recorder
from smsl_studio.front.script.player import ScriptPlayer
from smsl_studio.runlog.events import Event
from smsl_studio.stop import GRACE, Stopped, graceful

NAP = GRACE / 2
"""The longest (wall seconds) a paced run sleeps before it looks whether it shall stop."""

BLINK = 1e-4
"""What is left of a pause (wall seconds) that is not worth sleeping for."""


class StopAsked:
    """Whether a run shall stop, and whether it was told so already; ``when`` is asked."""

    def __init__(self, when: Callable[[], bool] | None) -> None:
        self.obeyed = False
        self._when = when

    def __bool__(self) -> bool:
        return not self.obeyed and self._when is not None and self._when()

    def heed(self) -> None:
        """Call off what the run is at, so that it may be told."""
        if self:
            raise Stopped


def to_its_end(
    dispatcher: Dispatcher,
    recording: Recorder,
    speed: float | None,
    asked: StopAsked,
    acting: ScriptPlayer | None,
) -> None:
    """Tick until ``run_finished`` is told, paced by ``speed`` (see ``front.run``).

    Once a stop is ``asked`` for, also in the middle of a tick that lasts, the run ends where it
    brakes. Stopped where its world was not open yet.
    """

    def tell(events: tuple[Event, ...]) -> None:
        """Hand events to the recording, and to whoever acts for people."""
        recording.tell(events)
        if acting is not None:
            acting.hear(events)

    tell(dispatcher.open())
    if dispatcher.opened is not None and dispatcher.opened.remote is not None:
        # Sensors elsewhere speak in wall time, and have to be waited for.
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
