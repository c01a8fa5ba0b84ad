"""Ways to what is no element of the canvas: a fact, a hazard, another file."""

from __future__ import annotations

from pathlib import Path

from smsl_studio.studio.document.files.files import Files
from smsl_studio.studio.features.draw.panels.properties import Properties
from smsl_studio.studio.shell.frame.docks import Docks


class Destinations:
    """Shows facts and hazards in the properties, and opens files."""

    def __init__(self, docks: Docks, properties: Properties, files: Files) -> None:
        self._docks, self._properties, self._files = docks, properties, files

    def show_fact(self, branch: str, digit: int) -> None:
        """Show what a fact means."""
        self._docks.show_tab("Properties")
        self._properties.show_fact(branch, digit)

    def show_hazard(self, name: str) -> None:
        """Show a hazard."""
        self._docks.show_tab("Properties")
        self._properties.show_hazard(name)

    def open_file(self, path: Path) -> None:
        self._files.open(path)

    @property
    def recent_files(self) -> tuple[Path, ...]:
        """The files opened or saved last."""
        return self._files.recent
