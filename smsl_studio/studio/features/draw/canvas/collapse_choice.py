"""CollapseChoice: whether a person wants the drawing of a file collapsed."""

from __future__ import annotations

from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.document.files.files import Files

KEPT = 100
"""The choices of so many files are remembered, newest first."""
KEY = "collapsed"


class CollapseChoice:
    """Keeps the choice for each file in the settings, never in the file. A drawing that was never
    saved has its choice until the window closes.
    """

    def __init__(self, canvas: Canvas, files: Files, settings: Settings) -> None:
        self._canvas, self._files, self._settings = canvas, files, settings
        self._unsaved: dict[str, bool] = {}
        canvas.collapse_choice = self.of_file
        canvas.collapse_wanted.connect(self.choose)

    def of_file(self) -> bool | None:
        """What the person chose for the present file; None if there was no choice."""
        path = self._files.path
        if path is None:
            return self._unsaved.get(self._files.name)
        return self._known().get(path.as_uri())

    def choose(self, on: bool) -> None:
        """Collapse the drawing or show all operations, now and whenever the file is opened."""
        path = self._files.path
        if path is None:
            self._unsaved[self._files.name] = on
        else:
            # A URI has no spaces and no line breaks, whatever the name of the file.
            known = {path.as_uri(): on, **self._known()} | {path.as_uri(): on}
            lines = [f"{'on' if one else 'off'} {name}" for name, one in known.items()]
            self._settings.store_text(KEY, "\n".join(lines[:KEPT]))
        self._canvas.set_collapsed(on)

    def turn(self) -> None:
        """Choose the other way."""
        self.choose(not self._canvas.collapsed)

    def _known(self) -> dict[str, bool]:
        lines = (line.partition(" ") for line in self._settings.text_of(KEY).split("\n"))
        return {name: word == "on" for word, _, name in lines if name}
