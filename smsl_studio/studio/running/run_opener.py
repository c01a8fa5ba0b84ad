"""Opens a run of the window: the answer whether it may start, its dispatcher, and its log."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from pathlib import Path

from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.errors import RunRefused, SaveError, StudioError
from smsl_studio.front.recorder import Recorder
from smsl_studio.front.request import RunRequest
from smsl_studio.front.runs import open_request, told_refusals, trusted_request
from smsl_studio.host.spare import Spare
from smsl_studio.library.loaded import Loaded
from smsl_studio.runlog.log import RunLog
from smsl_studio.studio.running.run_choice import log_of


class RunOpener:
    """What the thread of a run calls to open it.

    ``folder`` is that of the recordings (None: no log), and ``who`` the person at the window.
    ``written`` is the log, if there is one.
    """

    def __init__(self, request: RunRequest, loaded: Loaded | None, folder: Path | None,
                 who: str, spare: Spare | None) -> None:  # fmt: skip
        self._request, self._loaded = replace(request, person=who), loaded
        self._folder, self._who, self._spare = folder, who, spare
        self.written: Path | None = None

    def dispatcher(self) -> Dispatcher:
        """Ask whether the run may start, and return its dispatcher.

        RunRefused if it may not. If it needed an approval, the log has the reasons then.
        """
        try:
            self._request = trusted_request(self._request)
            trust = self._request.trust
            if trust is not None and trust.loaded is not None:
                # The plugins that were verified, and not those that the window had found before.
                self._loaded = trust.loaded
            return open_request(self._request, self._loaded, self._spare)
        except RunRefused as error:
            if error.refusals:
                self._write(error)
            raise

    def log(self) -> RunLog | None:
        """Begin the log; None if runs are not recorded. RunRefused if it cannot be written."""
        if self._folder is None:
            return None
        try:
            log = log_of(self._request, self._loaded, self._folder, self._who)
        except SaveError as error:
            raise self.refusal(error) from None
        self.written = log.path
        return log

    def _write(self, error: RunRefused) -> None:
        """Write a log that has the refusal alone, if it can be written."""
        with suppress(StudioError):
            recording = Recorder(lambda _: None, self.log())
            recording.end("refused", error.words, None, error.told)
            recording.close()

    def refusal(self, error: StudioError) -> StudioError:
        """Return an error at the start with its codes, if the run needed an approval."""
        told = told_refusals(self._request, "refused", error)
        if not told:
            return error
        codes = [(one["code"], one["sentence"]) for one in told]
        return RunRefused(error.sentence, error.place, error.advice, refusals=codes)
