"""The page Inspection as a feature: its panel below the drawing, and its row in the menu View."""

from __future__ import annotations

from smsl_studio.blueprint.address import Address
from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.feature import DockPanel, Feature, Shell
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.inspection.lit_run import LitRun
from smsl_studio.studio.features.inspection.panel import InspectionPanel
from smsl_studio.studio.running.window_parts import WindowParts

NAME = "Inspection"


class InspectionFeature(Feature):
    """Shows whether hazards and properties hold. ``canvas`` is that of the drawing."""

    def __init__(self, parts: WindowParts, shell: Shell, canvas: Canvas) -> None:
        self._parts, self._shell, self._canvas = parts, shell, canvas
        lit = LitRun(parts.session, canvas, parts.window)
        self.panel = InspectionPanel(parts.session, parts.inspector, lit, parts.tokens)
        self.panel.unproved.connect(lambda count: shell.show_count(NAME, count))
        self.panels = (
            DockPanel(NAME, "bottom", self.panel, self.panel.tools, tall=True, after="Findings"),
        )

    def actions(self) -> tuple[Action, ...]:
        """The row of the menu View."""
        return (
            Action("show_inspection", NAME, self._enter, "View", "", ("Ctrl+I",),
                   lambda: self._shell.mode == "draw", section=3,
                   tip="What must hold, and whether it does; once more: back to the drawing"),
        )  # fmt: skip

    def show_claim(self, address: Address) -> None:
        """Show a hazard or a property."""
        self._shell.show_tab(NAME)
        self.panel.choose(address)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.panel.set_tokens(tokens)

    def _enter(self) -> None:
        if not self._shell.sides.enter_tab(NAME):
            self._canvas.setFocus()
