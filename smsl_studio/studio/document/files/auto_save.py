"""Saves a file by itself, if the person has chosen so, and if no question would come up."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

from PySide6.QtCore import QObject, QTimer

from smsl_studio.blueprint.project import real_path
from smsl_studio.smsl.traits import losses
from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.document.files.files import Files
from smsl_studio.studio.document.session import Session

WAIT = 60_000
"""Milliseconds from the last change to the save."""


class AutoSave(QObject):
    """Saves some time after the last change, as Save does.

    It does nothing to a drawing without a file, to a text that cannot be read, to a file that
    another program has written, and to a file that a save would change otherwise. Save asks about
    each of these.
    """

    def __init__(
        self, session: Session, files: Files, settings: Settings, wait: int = WAIT
    ) -> None:
        super().__init__(files)
        self._session, self._files, self._settings = session, files, settings
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.setInterval(wait)
        self._timer.timeout.connect(self.save)
        session.stepped.connect(lambda _: self._timer.start())

    def save(self) -> bool:
        """Save now if that is wanted and needs no question; returns whether it was saved."""
        if not self._settings.autosave or not self._files.edited or self._asks():
            return False
        return self._files.save(by_itself=True)

    def _asks(self) -> bool:
        """Whether Save would ask something."""
        files = self._files
        if files.path is None or self._session.broken is not None:
            return True
        for file in files.unsaved:
            own = file == self._session.blueprint.file
            place = files.path if own else Path(file)
            if files.on_disk.look(file).changed:
                return True
            lost: tuple[str, ...] = ("all",)
            with suppress(OSError):
                lost = losses(Path(real_path(str(place))))
            if lost:
                return True
        return False
