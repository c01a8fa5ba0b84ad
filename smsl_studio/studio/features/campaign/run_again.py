"""A run of a campaign is carried out again with a log, so that it can be looked at."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QObject

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import SaveError, StudioError
from smsl_studio.front.campaign_faults import CampaignRequest
from smsl_studio.front.campaign_runs import RunVerdict
from smsl_studio.front.campaign_tally import CampaignCell
from smsl_studio.front.recordings import Recording, open_recording
from smsl_studio.studio.base.beside import Beside
from smsl_studio.studio.features.campaign.work import CampaignWork

MOST_KEPT = 50
"""The largest number of files of a folder that are kept."""
OTHER = "This run is not the one of the campaign: its events differ."

Came = Callable[[Path, Recording, bool], object]
"""Gets the log of a run, the run, and whether it is another one than before."""


class RunAgain(QObject):
    """Carries runs out again, one at a time, and keeps their logs while the window is open.

    ``folder`` is that of the campaigns.
    """

    def __init__(self, work: CampaignWork, folder: Path, parent: QObject) -> None:
        super().__init__(parent)
        self._work, self._folder = work, folder / "replays"
        self._known: dict[tuple[int, int], tuple[Path, bool]] = {}
        """The logs of the campaign that is shown, and whether each is another run, by row and
        seed."""
        self._for: CampaignRequest | None = None
        self._reading = Beside(self)

    def look(
        self, cell: CampaignCell, seed: int, came: Came, refused: Callable[[StudioError], object]
    ) -> None:
        """Tell ``came`` of a run. What was asked for before is given up. ``refused`` gets the
        reason if it cannot be carried out."""
        work = self._work
        assert work.request is not None
        request, before = work.request, cell.verdicts[seed]
        self.drop()
        if request is not self._for:
            self._for = request
            self._known.clear()
        key = cell.row, seed
        known = self._known.get(key)

        def read(log: Path, other: bool) -> None:
            """Read the log in the worker thread, and hand it over."""
            self._reading.do(
                lambda: _read(log, request.blueprint),
                lambda told: (
                    refused(told) if isinstance(told, StudioError) else came(log, told, other)
                ),
            )

        if known is not None and known[0].is_file():
            read(*known)
            return
        name = f"{Path(request.blueprint.file).stem}-{cell.fault or 'none'}-{cell.row}-{seed}.jsonl"
        log = self._folder / name
        try:
            self._folder.mkdir(parents=True, exist_ok=True)
            log.unlink(missing_ok=True)
            forget_old(self._folder)
        except OSError as error:
            refused(SaveError(f"{log} was not written: {error.strerror or error}"))
            return

        def over(told: RunVerdict | StudioError) -> None:
            """Keep the log of a run that is over."""
            if not isinstance(told, RunVerdict):
                refused(told)
                return
            self._known[key] = log, told.sha256 != before.sha256
            read(*self._known[key])

        work.record(request.run(seed, cell.injection), log, over)

    def drop(self) -> None:
        """Give up what was asked for."""
        self._work.drop_record()
        self._reading.drop()

    def stop(self) -> None:
        """End all work, because the window closes."""
        self._reading.stop()


def _read(log: Path, blueprint: Blueprint) -> Recording | StudioError:
    try:
        return open_recording(log, blueprint)
    except StudioError as error:
        return error


def forget_old(folder: Path) -> None:
    """Remove the files of a folder that are older than the ``MOST_KEPT`` newest ones."""
    files = sorted(folder.glob("*.jsonl"), key=lambda one: one.stat().st_mtime, reverse=True)
    for one in files[MOST_KEPT:]:
        one.unlink(missing_ok=True)
