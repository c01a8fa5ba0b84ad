"""A world in waiting, so that the next run begins at once."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QObject, QTimer

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.hosts import make_ready
from smsl_studio.host.spare import Spare
from smsl_studio.library.loaded import Loaded

QUIET = 700
"""Milliseconds without a change after which it is worth building a world."""

Wanted = tuple[Blueprint, str, int, Loaded]


class SpareWorld(QObject):
    """Keeps a spare child ready for the run that the person would begin now.

    ``wanted`` tells blueprint, world, seed and plugins of that run, None where there would be none.
    Without a ``spare`` nothing is kept ready, and runs start their own children.
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
        """Something has changed: once it is quiet, have a world ready for it."""
        if self.spare is not None:
            self._quiet.start()

    def _warm(self) -> None:
        wanted = self._wanted()
        if self.spare is not None and wanted is not None:
            make_ready(self.spare, *wanted)
