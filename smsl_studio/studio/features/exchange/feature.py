"""Import and export of other programs' forms as a feature: its rows in the menu File."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.feature import Feature, Shell
from smsl_studio.studio.base.late_part import LatePart
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.running.window_parts import WindowParts

if TYPE_CHECKING:
    from smsl_studio.studio.features.exchange.verbs import ExchangeVerbs

DROPPED = (".scxml", ".graphml", ".xstate.json")
"""Files that only another program can have written, so that opening them imports them."""


class ExchangeFeature(Feature):
    """Imports a blueprint from another program's file, and exports the one that is open."""

    def __init__(self, parts: WindowParts, shell: Shell) -> None:
        self._parts, self._shell, self._tokens = parts, shell, parts.tokens
        self.verbs = LatePart(self._make)

    def actions(self) -> tuple[Action, ...]:
        """The rows of the menu File."""
        return (
            Action("import", "Import from another program…", lambda: self.verbs().import_file(),
                   "File", "", (), section=1,
                   tip="Read SCXML, GraphML, XState, RAFCON or FlexBE as a new blueprint"),
            Action("export", "Export for another program…", lambda: self.verbs().export_file(),
                   "File", "", (), self._can, section=1,
                   tip="Write SCXML, GraphML, XState, Promela, PRISM, a behavior tree or a table"),
        )  # fmt: skip

    def open_path(self, path: Path) -> bool:
        """Import a file that only another program can have written."""
        if not path.name.lower().endswith(DROPPED):
            return False
        self.verbs().read(path)
        return True

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme for the next list."""
        self._tokens = tokens

    def stop(self) -> None:
        """End the work, because the window closes."""
        if self.verbs.made is not None:
            self.verbs.made.beside.stop()

    def _can(self) -> bool:
        return self._parts.files.is_open and self._shell.mode == "draw"

    def _make(self) -> ExchangeVerbs:
        from smsl_studio.studio.features.exchange.verbs import ExchangeVerbs

        return ExchangeVerbs(self._parts, lambda: self._tokens)
