"""The page Inspection as a feature: its panel below the drawing, and its row in the menu View."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from smsl_studio.blueprint.address import Address
from smsl_studio.errors import StudioError
from smsl_studio.front.views.claim_run import RunStep
from smsl_studio.smsl.files import save_document
from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.feature import DockPanel, Feature, Shell
from smsl_studio.studio.base.late_panel import LatePanel
from smsl_studio.studio.base.late_part import LatePart
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.document.files.dialogs import Dialogs
from smsl_studio.studio.features.inspection.page_tools import PageTools
from smsl_studio.studio.features.inspection.unproved import Unproved
from smsl_studio.studio.running.window_parts import WindowParts

if TYPE_CHECKING:
    from smsl_studio.studio.features.inspection.panel import InspectionPanel

NAME = "Inspection"


class InspectionFeature(Feature):
    """Shows whether hazards and properties hold. ``canvas`` is that of the drawing.

    The page is made when it is first needed. The number on its tab is there before.
    """

    def __init__(self, parts: WindowParts, shell: Shell, canvas: Canvas) -> None:
        self._parts, self._shell, self._canvas, self._tokens = parts, shell, canvas, parts.tokens
        self.play: Callable[[str, str], None] = lambda text, name: None
        """Runs the text of a script with a name; another feature has the runs."""
        self.start_at: Callable[[tuple[str, ...]], None] = lambda states: None
        """Lets the next run start in these states. The feature Run sets it."""
        self.part: LatePart[InspectionPanel] = LatePart(self._make)
        self._tools = PageTools()
        self._unproved = Unproved(parts.session, parts.inspector)
        self._unproved.counted.connect(lambda count: shell.show_count(NAME, count))
        self.panels = (
            DockPanel(NAME, "bottom", LatePanel(self.part), self._tools, tall=True,
                      after="Findings"),
        )  # fmt: skip

    @property
    def panel(self) -> InspectionPanel:
        """The page."""
        return self.part()

    def _make(self) -> InspectionPanel:
        from smsl_studio.studio.features.inspection.lit_run import LitRun
        from smsl_studio.studio.features.inspection.panel import InspectionPanel

        parts = self._parts
        lit = LitRun(parts.session, self._canvas, parts.window)
        panel = InspectionPanel(parts.session, parts.inspector, lit, self._tools, self._tokens)
        parts.files.take_over = panel.writing.take_over
        for run in (panel.run, panel.configuration.run, panel.equivalence.run):
            run.play_wanted.connect(lambda text: self.play(text, self._name))
            run.save_wanted.connect(self._save)
        panel.configuration.start_wanted.connect(lambda states: self.start_at(states))
        return panel

    def actions(self) -> tuple[Action, ...]:
        """The row of the menu View."""
        return (
            Action("show_inspection", NAME, self._enter, "View", "", ("Ctrl+I",),
                   lambda: self._shell.mode == "draw", section=3, inner="Panels",
                   tip="What must hold, and whether it does; once more: back to the drawing"),
        )  # fmt: skip

    def stop(self) -> None:
        """End all work, because the window closes."""
        panel = self.part.made
        if panel is not None:
            for part in (panel.look, panel.configuration, panel.equivalence, panel.writing):
                part.stop()

    def show_page(self) -> None:
        """Show the page with the keyboard on it."""
        self._shell.show_tab(NAME)
        panel = self.panel
        panel.show_verdicts()
        (panel.table if panel.table.isVisible() else panel.add_empty).setFocus()

    def show_run(self, steps: tuple[RunStep, ...], title: str) -> None:
        """Show a run that another feature has found, on the page and on the drawing."""
        self._shell.show_tab(NAME)
        self.panel.show_steps(steps, title)

    def show_claim(self, address: Address) -> None:
        """Show a hazard or a property."""
        self._shell.show_tab(NAME)
        self.panel.choose(address)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        if self.part.made is not None:
            self.part.made.set_tokens(tokens)

    @property
    def _name(self) -> str:
        """The name of the script file for the run that is shown."""
        return f"{Path(self._parts.session.blueprint.file).stem}-shown.jsonl"

    def _save(self, text: str) -> None:
        """Ask for a file and write the script into it, completely or not at all."""
        path = self._parts.files.path
        folder = path.parent if path is not None else Path.home()
        target = Dialogs(self._parts.window).script_to_save(folder / self._name)
        if target is None:
            return
        try:
            save_document(text, target)
        except StudioError as error:
            self._parts.toast.refuse(error)
        else:
            self._parts.toast.say(f"Saved {target.name}. “smsl-studio run --script” plays it")

    def _enter(self) -> None:
        if not self._shell.sides.enter_tab(NAME):
            self._canvas.setFocus()
