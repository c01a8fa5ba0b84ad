"""The recorder of a run: it writes each event to the log first, then hands it to a listener."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from datetime import datetime
from itertools import count
from pathlib import Path

from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.errors import SaveError, UsageError
from smsl_studio.front.request import RunRequest
from smsl_studio.front.run_header import log_header
from smsl_studio.library.loaded import Loaded
from smsl_studio.runlog.ends import UNBEGUN
from smsl_studio.runlog.events import Event, Held, RunFinished
from smsl_studio.runlog.log import RunLog
from smsl_studio.stop import unheeding, whole


class Recorder:
    """Writes the events of a run to ``log`` (None: no recording), then hands them to ``hear``.

    While there is a log, the listener gets only events that the log contains. ``told`` is the
    number of events that the listener has got, and ``last`` is the newest of them.
    """

    def __init__(self, hear: Callable[[Event], None], log: RunLog | None = None) -> None:
        self.told = 0
        self.last: Event | None = None
        self.log = log
        self._hear = hear

    def tell(self, events: Iterable[Event]) -> None:
        """Record events and hand them on. The log gets its head after ``run_finished``.

        SaveError if the log cannot be written. Then the log is closed, and the listener does not
        get the event.
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
        """Write events to the log. Return the written events, and the error if there was one."""
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

    def end(
        self,
        reason: str,
        sentence: str,
        dispatcher: Dispatcher | None,
        refusals: Sequence[Mapping[str, str]] = (),
    ) -> None:
        """Record the end of a run if its dispatcher cannot report it.

        A failure is first recorded as the event ``held``. Each of the ``refusals`` has a code and a
        sentence.
        """
        finished = (
            RunFinished(t=0.0, reason=reason, sentence=sentence, operations=0, configuration={})
            if dispatcher is None
            else dispatcher.end_for(reason, sentence)
        )
        finished = replace(finished, refusals=tuple(refusals))
        held = Held(t=finished.t, reason=sentence)
        self._end([held, finished] if reason == "failed" else [finished])

    def begin_late(self, begin: Callable[[], RunLog]) -> None:
        """Begin a log for a run that was called off before it had one. It raises the same errors as
        ``start_log``."""
        if self.log is None and not self.told:
            with unheeding(), whole():
                self.log = begin()

    def stop(self, dispatcher: Dispatcher | None) -> None:
        """Record the end of a run that was called off without a command to its dispatcher."""
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
        """Close the log. A second call does nothing."""
        if self.log is not None:
            self.log.close()
        self.log = None


def start_log(request: RunRequest, loaded: Loaded | None) -> RunLog:
    """Create the log of a requested run, with its header (see ``log_header``).

    SaveError if it cannot be written. UsageError if the file is not empty, or if no file is named.
    """
    if request.log is None:
        raise UsageError("no file is named for the log of this run")
    return RunLog(request.log, log_header(request, loaded), request.seal)


def new_recording(folder: Path, file: str, now: datetime) -> Path:
    """Return a new name for a recording in ``folder``: ``<file>-<date>.jsonl``.

    The folder is created. SaveError if that is not possible.
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
