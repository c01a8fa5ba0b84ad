"""The process of the automatic supervisors, seen from the run: it is asked, and ended if it hangs.

A supervisor that gives no answer in its time costs that time and no more: its process is killed,
and another one begins to load at once, for the next question.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

from smsl_studio.errors import HostError, UsageError
from smsl_studio.front.agents.agent_child import ANSWER, READY, REFUSAL
from smsl_studio.front.agents.asked_agent import AskedAgent
from smsl_studio.host.codec import Unfit
from smsl_studio.host.exit_words import ending_words
from smsl_studio.host.started_child import Child, start_child
from smsl_studio.host.wire import NoAnswer
from smsl_studio.library.supervisor_view import ASK, SupervisorView
from smsl_studio.stop import heed

CHILD = "smsl_studio.front.agents.agent_child"
START = 20.0
"""The wall time (s) that all supervisors may take to load."""
LOOK = 0.02
"""The wall time (s) between two checks for a stop."""
LIVES = 4
"""After so many lost processes, no further one is started."""


class AgentProcess:
    """The supervisors that were asked for. ``names`` are their texts, in the order of asking."""

    def __init__(self, asked: Sequence[AskedAgent], plugin_paths: Sequence[Path] = ()) -> None:
        self._asked = tuple(asked)
        self._paths = tuple(map(str, plugin_paths))
        self._child: Child | None = None
        self._limits: tuple[float, ...] = ()
        self.forecasts = False
        """Whether one of them decides by forecasts; known when they are loaded."""
        self._ready = False
        self._lost = 0
        self._why = ""

    def open(self) -> None:
        """Wait until the supervisors are loaded. Start their process if there is none.

        UsageError if one does not exist or its options do not fit. HostError if the process is lost
        meanwhile.
        """
        if self._ready:
            return
        child = self._child or self._begin()
        try:
            kind, body = self._heard(child, START)
            if kind == "refused":
                raise UsageError(REFUSAL.decode(body))
            ready = READY.decode(body)
            self._limits = tuple(limit for _, limit, _ in ready)
            self.forecasts = any(wants for _, _, wants in ready)
            if len(self._limits) != len(self._asked):
                raise NoAnswer("it names other supervisors")
            self._ready = True
        except (TimeoutError, EOFError, OSError, NoAnswer, Unfit) as error:
            words = self._lose(child, error, START)
            raise HostError(f"the process of the supervisors {words}") from None
        except BaseException:
            self.close()
            raise

    def _begin(self) -> Child:
        """Start a process, and let it load the supervisors. HostError if none can be started."""
        try:
            self._child = child = start_child(CHILD)
        except OSError as error:
            raise HostError(f"no process can be started: {error.strerror or error}") from None
        child.tell("open", (self._asked, self._paths))
        return child

    def ask(self, number: int, view: SupervisorView) -> tuple[str, str]:
        """Ask one supervisor. Return its answer and its reason.

        ``ask`` is the answer if it has none in its time, or if its process is lost.
        """
        if self._lost >= LIVES:
            return ASK, f"it is not asked any more: {self._why}"
        limit = self._limits[number] if self._limits else START
        try:
            self.open()
        except (HostError, UsageError) as error:
            return ASK, error.sentence
        child = self._child
        assert child is not None
        try:
            child.wire.send("review", (number, view))
            kind, body = self._heard(child, limit)
            if kind != "ok":
                raise NoAnswer(f"it says {kind}")
            return ANSWER.decode(body)
        except (TimeoutError, EOFError, OSError, NoAnswer, Unfit) as error:
            return ASK, f"it {self._lose(child, error, limit)}"
        except BaseException:
            # Its answer would come to the next question.
            self.close()
            raise

    def close(self) -> None:
        """End the process. A second call does nothing."""
        child, self._child, self._ready = self._child, None, False
        if child is not None:
            child.told()
            child.release()

    def _heard(self, child: Child, limit: float) -> tuple[str, bytes]:
        """Wait for the next frame, at most ``limit`` seconds of wall time. TimeoutError after
        that."""
        child.told()
        until = time.monotonic() + limit
        while True:
            heed()
            frame = child.heard(max(0.0, min(LOOK, until - time.monotonic())))
            if frame is not None and frame.kind != "loads":
                return frame.kind, frame.body
            if time.monotonic() >= until:
                raise TimeoutError

    def _lose(self, child: Child, error: Exception, limit: float) -> str:
        """Kill a process that is of no more use, and say why in words."""
        if isinstance(error, TimeoutError):
            words = f"gave no answer in {limit:g} s"
        elif isinstance(error, NoAnswer | Unfit):
            words = f"said what is no answer: {error}"
        else:
            words = ending_words(child.ending())
        self._lost, self._why = self._lost + 1, f"it {words}"
        self._child, self._ready = None, False
        child.kill()
        if self._limits and self._lost < LIVES:
            with suppress(HostError):  # the next question starts it
                self._begin()
        return words
