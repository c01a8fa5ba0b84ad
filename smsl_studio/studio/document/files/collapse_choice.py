"""CollapseChoice: keeps in the settings whether a person wants a file's drawings collapsed."""

from __future__ import annotations

from pathlib import Path

from smsl_studio.studio.base.canvas.shared_collapse import SharedCollapse
from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.document.files.files import Files
from smsl_studio.studio.document.session import Session

KEPT = 100
"""The number of files whose choices are remembered. The oldest choice is forgotten first."""
KEY = "collapsed"


class CollapseChoice(SharedCollapse):
    """Keeps the choice for each file in the settings. The file itself does not change.

    The choice for a drawing that was never saved is kept until the window closes.
    """

    def __init__(self, session: Session, files: Files, settings: Settings) -> None:
        super().__init__(files)
        self._session, self._files, self._settings = session, files, settings

    def wish(self, file: str) -> bool | None:
        """The person's choice for a file. None if the person has not chosen."""
        path = self._path(file)
        return self._known().get(path.as_uri()) if path is not None else super().wish(file)

    def keep(self, file: str, on: bool) -> None:
        """Remember the choice for a file, also for the next start of the program."""
        path = self._path(file)
        if path is None:
            super().keep(file, on)
            return
        # A URI has no spaces and no line breaks, even if the name of the file has some.
        known = {path.as_uri(): on, **self._known()} | {path.as_uri(): on}
        lines = [f"{'on' if one else 'off'} {name}" for name, one in known.items()]
        self._settings.store_text(KEY, "\n".join(lines[:KEPT]))

    def _path(self, file: str) -> Path | None:
        """The path of a file on the disk. None for a drawing that was never saved."""
        return self._files.path if file == self._session.blueprint.file else None

    def _known(self) -> dict[str, bool]:
        lines = (line.partition(" ") for line in self._settings.text_of(KEY).split("\n"))
        return {name: word == "on" for word, _, name in lines if name}
