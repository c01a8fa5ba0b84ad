"""The map of branches as a feature: its row in the menu View."""

from __future__ import annotations

from typing import TYPE_CHECKING

from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.feature import Feature, Shell
from smsl_studio.studio.base.late_part import LatePart
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.running.window_parts import WindowParts

if TYPE_CHECKING:
    from smsl_studio.studio.features.branch_map.map_window import MapWindow


class BranchMapFeature(Feature):
    """Shows the map in a window of its own. The window is made when it is first opened."""

    def __init__(self, parts: WindowParts, shell: Shell) -> None:
        self._parts, self._shell, self._tokens = parts, shell, parts.tokens
        self.part = LatePart(self._make)

    def actions(self) -> tuple[Action, ...]:
        """The row of the menu View."""
        return (
            Action("branch_map", "Map of branches", self.show, "View", "", ("Ctrl+Shift+O",),
                   lambda: bool(self._parts.session.blueprint.branches),
                   tip="All State Branches, and which fact leads to which sub-SB"),
        )  # fmt: skip

    def show(self) -> None:
        """Show the map, or bring it to the front."""
        self.part().open()

    def _make(self) -> MapWindow:
        from smsl_studio.studio.features.branch_map.map_window import MapWindow

        made = MapWindow(self._parts.session, self._tokens, self._parts.window)
        made.branch_wanted.connect(self._go_in)
        return made

    def _go_in(self, branch: str) -> None:
        """Show an SB in the drawing."""
        self._shell.set_mode("draw")
        self._parts.session.show_branch(branch)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        if self.part.made is not None:
            self.part.made.set_tokens(tokens)
