"""Ways to what is no element of the canvas: a fact, a hazard, another file."""

from __future__ import annotations

from pathlib import Path
from typing import Protocol

from smsl_studio.studio.document.files.files import Files
from smsl_studio.studio.features.draw.panels.properties import Properties


class Panels(Protocol):
    """What brings a panel to the front by its name."""

    def show_tab(self, name: str) -> None:
        """Bring the panel of this name to the front."""


class Destinations:
    """Shows facts and hazards in the properties, and opens files."""

    def __init__(self, panels: Panels, properties: Properties, files: Files) -> None:
        self._panels, self._properties, self._files = panels, properties, files

    def show_fact(self, branch: str, digit: int) -> None:
        """Show what a fact means."""
        self._panels.show_tab("Properties")
        self._properties.show_fact(branch, digit)

    def show_hazard(self, name: str) -> None:
        """Show a hazard."""
        self._panels.show_tab("Properties")
        self._properties.show_hazard(name)

    def open_file(self, path: Path) -> None:
        """Open a file in this window."""
        self._files.open(path)

    @property
    def recent_files(self) -> tuple[Path, ...]:
        """The files opened or saved last."""
        return self._files.recent
