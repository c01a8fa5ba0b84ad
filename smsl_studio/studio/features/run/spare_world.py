"""A world kept ready, so that the next run begins at once."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QObject, QTimer

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.hosts import make_ready
from smsl_studio.host.spare import Spare
from smsl_studio.library.loaded import Loaded

QUIET = 700
"""Milliseconds without a change before a world is prepared."""

Wanted = tuple[Blueprint, str, int, Loaded, str]


class SpareWorld(QObject):
    """Prepares a spare process for the run that Play would begin.

    ``wanted`` returns blueprint, world, seed, plugins and robot of that run, or None. Without a
    ``spare`` nothing is prepared, and each run starts its own process.
    """

    def __init__(self, wanted: Callable[[], Wanted | None], parent: QObject) -> None:
        super().__init__(parent)
        self.spare: Spare | None = None
        self._wanted = wanted
        self._quiet = QTimer(self)
        self._quiet.setSingleShot(True)
        self._quiet.setInterval(QUIET)
        self._quiet.timeout.connect(self._warm)

    def soon(self) -> None:
        """Prepare a world after some time without another change."""
        if self.spare is not None:
            self._quiet.start()

    def _warm(self) -> None:
        wanted = self._wanted()
        if self.spare is not None and wanted is not None:
            make_ready(self.spare, *wanted)
