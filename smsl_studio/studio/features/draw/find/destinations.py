"""How search shows targets that are not on the canvas: facts, hazards, plugins, files."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Protocol

from smsl_studio.blueprint.address import Address
from smsl_studio.studio.document.files.files import Files
from smsl_studio.studio.features.draw.panels.library import Library
from smsl_studio.studio.features.draw.panels.properties import Properties


class Panels(Protocol):
    """A part that can bring a panel to the front."""

    def show_tab(self, name: str) -> None:
        """Bring the panel with this name to the front."""


class Destinations:
    """Opens the result of a search at the right place.

    A fact is shown in the panel Properties, a hazard on the page Inspection, and an operation of a
    plugin in the panel Library. A file is opened.
    """

    def __init__(
        self, panels: Panels, properties: Properties, library: Library, files: Files
    ) -> None:
        self._panels, self._properties, self._files = panels, properties, files
        self._library = library
        self.show_claim: Callable[[Address], None] = lambda address: None
        """Shows a hazard or a property; another feature has the page."""

    def show_fact(self, branch: str, digit: int) -> None:
        """Show a fact in the properties panel."""
        self._panels.show_tab("Properties")
        self._properties.show_fact(branch, digit)

    def show_hazard(self, name: str) -> None:
        """Show a hazard on the page that answers it."""
        self.show_claim(Address("_hazards", name))

    def show_offered(self, pattern: str) -> None:
        """Show an operation that a plugin offers, in the library."""
        self._panels.show_tab("Library")
        self._library.reveal(pattern)

    def open_file(self, path: Path) -> None:
        """Open a file in this window."""
        self._files.open(path)

    @property
    def recent_files(self) -> tuple[Path, ...]:
        """The files that were opened or saved last."""
        return self._files.recent
