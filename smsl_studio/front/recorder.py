"""Recording a run: into its log first, then to whoever listens; headless and in the window."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Sequence
from datetime import datetime
from itertools import count
from pathlib import Path

from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.errors import SaveError, UsageError
from smsl_studio.front.request import RunRequest
from smsl_studio.front.run_header import log_header
from smsl_studio.library.loading import Loaded
from smsl_studio.runlog.ends import UNBEGUN
from smsl_studio.runlog.events import Event, Held, RunFinished
from smsl_studio.runlog.log import RunLog
from smsl_studio.stop import unheeding, whole


class Recorder:
    """What a run says, on its way: written to ``log`` (None: it is not recorded), then heard.

    Nobody hears what the log does not have, as long as it lives. ``told`` counts what was heard,
    ``last`` is the newest of it.
    """

    def __init__(self, hear: Callable[[Event], None], log: RunLog | None = None) -> None:
        self.told = 0
        self.last: Event | None = None
        self.log = log
        self._hear = hear

    def tell(self, events: Iterable[Event]) -> None:
        """Record and hand on; the log gets its head after ``run_finished``.

        SaveError where the log cannot be written: it is then closed, and the event unheard.
        """
        told, failed = tuple(events), None
        if self.log is not None:
            told, failed = self._logged(self.log, told)
        for event in told:
            self.told += 1
            self.last = event
            self._hear(event)
        if failed is not None:
            raise failed

    def _logged(
        self, log: RunLog, events: tuple[Event, ...]
    ) -> tuple[tuple[Event, ...], SaveError | None]:
        """Write events to the log; those that it has, and why it has no more."""
        with whole():
            for index, event in enumerate(events):
                try:
                    log.write([event])
                    if isinstance(event, RunFinished):
                        log.finish()
                except SaveError as error:
                    self.close()
                    return events[:index], error
        return events, None

    def end(self, reason: str, sentence: str, dispatcher: Dispatcher | None) -> None:
        """The end of a run that its dispatcher cannot tell; before a failure, that it holds."""
        finished = (
            RunFinished(t=0.0, reason=reason, sentence=sentence, operations=0, configuration={})
            if dispatcher is None
            else dispatcher.end_for(reason, sentence)
        )
        held = Held(t=finished.t, reason=sentence)
        self._end([held, finished] if reason == "failed" else [finished])

    def begin_late(self, begin: Callable[[], RunLog]) -> None:
        """Have a log, from ``begin``, for a run that was called off before it had one; SaveError
        and UsageError as of ``start_log``."""
        if self.log is None and not self.told:
            with unheeding(), whole():
                self.log = begin()

    def stop(self, dispatcher: Dispatcher | None) -> None:
        """The end of a run that was called off where its dispatcher could not be told."""
        if isinstance(self.last, RunFinished):
            return
        with unheeding():
            if dispatcher is None:
                self.end("stopped", UNBEGUN, None)
            else:
                self._end(dispatcher.break_off())

    def _end(self, last: Sequence[Event]) -> None:
        before = self.told
        try:
            self.tell(last)
        except SaveError:
            self.tell(last[self.told - before :])

    def close(self) -> None:
        """End the log where it stands; calling it twice is harmless."""
        if self.log is not None:
            self.log.close()
        self.log = None


def start_log(request: RunRequest, loaded: Loaded | None) -> RunLog:
    """The log of a run that is asked for, with its header written (see ``log_header``).

    SaveError where it cannot be written, UsageError where the file holds something already, or
    where none is named.
    """
    if request.log is None:
        raise UsageError("no file is named for the log of this run")
    return RunLog(request.log, log_header(request, loaded))


def new_recording(folder: Path, file: str, now: datetime) -> Path:
    """A name for a recording that no file in ``folder`` has: ``<file>-<date>.jsonl``.

    The folder is made. SaveError where that cannot be done.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise SaveError(
            f"the folder of recordings cannot be made: {error.strerror or error}",
            advice=f"Make room for {folder}, or record no runs.",
        ) from None
    stem = f"{Path(file).stem}-{now:%Y-%m-%d-%H%M%S}"
    names = (f"{stem}{f'-{n}' if n else ''}.jsonl" for n in count())
    return next(path for name in names if not os.path.lexists(path := folder / name))
