"""The campaign of a window: its process, what it has told so far, and how long it will take."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Sequence
from contextlib import closing
from dataclasses import replace
from pathlib import Path

from PySide6.QtCore import QObject, QTimer, Signal

from smsl_studio.errors import StudioError
from smsl_studio.front.campaign_child import CampaignChild, CampaignEnd
from smsl_studio.front.campaign_faults import CampaignRequest
from smsl_studio.front.campaign_runs import CampaignRun, Injection, RunVerdict
from smsl_studio.front.campaign_tally import CampaignTally
from smsl_studio.front.campaigns import CampaignWatch
from smsl_studio.front.fault_foresight import FaultEnd
from smsl_studio.studio.base.beside import Beside

NONE, RUNNING, PAUSING, PAUSED, DONE = "", "running", "pausing", "paused", "done"
LOOK = 100
"""Milliseconds between two looks at what was heard."""
MEMORY = 30.0
"""The pace of a campaign is that of the last so many seconds."""


class _Heard(CampaignWatch):
    """Keeps what the worker thread hears, until the window takes it."""

    def __init__(self) -> None:
        self.rows: tuple[Sequence[Injection | None], int] | None = None
        self.ends: deque[tuple[int, FaultEnd]] = deque()
        self.runs: deque[tuple[int, int, RunVerdict]] = deque()

    def begin(self, rows: Sequence[Injection | None], seeds: int) -> None:
        """Keep the rows."""
        self.rows = rows, seeds

    def foresee(self, row: int, end: FaultEnd) -> None:
        """Keep how the runs of a row were foreseen to end."""
        self.ends.append((row, end))

    def hear(self, row: int, seed: int, verdict: RunVerdict) -> None:
        """Keep how a run ended."""
        self.runs.append((row, seed, verdict))


class CampaignWork(QObject):
    """One campaign at a time. ``request`` is what was asked for last, ``tally`` what it told."""

    changed = Signal()
    """The phase, the tally or the time left changed."""
    refused = Signal(object)
    """A StudioError: the campaign cannot go on. What is done is kept."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.phase = NONE
        self.request: CampaignRequest | None = None
        self.tally = CampaignTally()
        self.digest = ""
        self.left_out: tuple[str, ...] = ()
        self._beside, self._aside = Beside(self), Beside(self)
        self._child: CampaignChild | None = None
        self._heard = _Heard()
        self._paces: deque[tuple[float, int]] = deque()
        self._timer = QTimer(self)
        self._timer.setInterval(LOOK)
        self._timer.timeout.connect(self._take)

    @property
    def moves(self) -> bool:
        """Whether runs are carried out now."""
        return self.phase in (RUNNING, PAUSING)

    @property
    def left(self) -> float | None:
        """How long the rest will take (s), None while nobody knows."""
        if not self.moves or len(self._paces) < 2:
            return None
        (then, before), (now, done) = self._paces[0], self._paces[-1]
        if done <= before or now - then < 1.0:
            return None
        return (self.tally.every - done) * (now - then) / (done - before)

    def start(self, request: CampaignRequest) -> None:
        """Begin a campaign, or go on with it: what ``request.part`` has is not run again."""
        self.stop()
        self.request, self.phase = replace(request, resume=True), RUNNING
        self.tally, self.digest, self.left_out = CampaignTally(), "", ()
        heard = self._heard = _Heard()
        self._paces.clear()
        wanted = self.request

        def work() -> CampaignEnd | StudioError:
            """Follow the process, in the worker thread."""
            try:
                with closing(CampaignChild(wanted)) as child:
                    self._child = child
                    return child.follow(heard)
            except StudioError as error:
                return error

        self._beside.do(work, self._end)
        self._timer.start()
        self.changed.emit()

    def pause(self) -> None:
        """Let the run end that is carried out now. Everything that is done is kept."""
        if self.phase == RUNNING and self._child is not None:
            self.phase = PAUSING
            self._child.pause()
            self.changed.emit()

    def resume(self) -> None:
        """Go on with a campaign that was paused or stopped."""
        if self.phase == PAUSED and self.request is not None:
            self.start(self.request)

    def stop(self) -> None:
        """End all workers now. Everything that is done is kept."""
        if self.moves:
            self._beside.drop()
            self._take()
            self._rest(PAUSED)

    def shut(self) -> None:
        """End all work, because the window closes."""
        self._timer.stop()
        self._beside.stop()
        self._aside.stop()

    def record(
        self, run: CampaignRun, log: Path, then: Callable[[RunVerdict | StudioError], None]
    ) -> None:
        """Carry out one run again and write its log. ``then`` gets how it ended this time."""
        assert self.request is not None
        wanted, heard = self.request, _Heard()

        def work() -> RunVerdict | StudioError:
            """Follow the process of the one run, in the worker thread."""
            try:
                with closing(CampaignChild(wanted, run, log)) as child:
                    child.follow(heard)
                return heard.runs[0][2]
            except StudioError as error:
                return error

        self._aside.do(work, then)

    def drop_record(self) -> None:
        """Give up the run that is carried out again."""
        self._aside.drop()

    def _take(self) -> None:
        """Take what was heard since the last look."""
        heard = self._heard
        if heard.rows is not None:
            self.tally.begin(*heard.rows)
            heard.rows = None
        if self.tally.cells:
            while heard.ends:
                self.tally.foresee(*heard.ends.popleft())
            while heard.runs:
                self.tally.hear(*heard.runs.popleft())
        now = time.monotonic()
        self._paces.append((now, self.tally.done))
        while now - self._paces[0][0] > MEMORY:
            self._paces.popleft()
        self.changed.emit()

    def _end(self, came: CampaignEnd | StudioError) -> None:
        self._take()
        if isinstance(came, StudioError):
            self._rest(PAUSED if self.tally.cells else NONE)
            self.refused.emit(came)
            return
        self.digest, self.left_out = came.digest, came.left_out
        self._rest(PAUSED if came.paused else DONE)

    def _rest(self, phase: str) -> None:
        self.phase, self._child = phase, None
        self._timer.stop()
        self.changed.emit()
