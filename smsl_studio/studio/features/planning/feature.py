"""Makes a drawing of a planning problem: two files are asked for, the domain and the problem."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from smsl_studio.errors import StudioError
from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.beside import Beside
from smsl_studio.studio.base.feature import Feature, Shell
from smsl_studio.studio.base.file_dialogs import ask_to_open
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.document.files.opened_file import OpenedFile
from smsl_studio.studio.running.window_parts import WindowParts

if TYPE_CHECKING:
    from smsl_studio.front.generated import Generated

KINDS = "Planning (*.pddl);;All files (*)"


class PlanningFeature(Feature):
    """One row in the menu Blueprint."""

    def __init__(self, parts: WindowParts, shell: Shell, inner: str) -> None:
        """``inner`` is the submenu of its row."""
        self._parts, self._shell, self._inner = parts, shell, inner
        self._beside = Beside(parts.window)

    def actions(self) -> tuple[Action, ...]:
        """The row of the menu Blueprint."""
        return (
            Action("planning_problem", "From planning problem…", self.ask, "Blueprint", "", (),
                   section=4, inner=self._inner,
                   tip="Make a drawing of a domain and a problem in PDDL", also="generate plan"),
        )  # fmt: skip

    def stop(self) -> None:
        """End all work, because the window closes."""
        self._beside.stop()

    def ask(self) -> None:
        """Ask for the two files, and make the drawing."""
        path = self._parts.files.path
        folder = path.parent if path is not None else Path.home()
        domain = ask_to_open(self._parts.window, "Open the domain", str(folder), KINDS)
        if not domain:
            return
        near = str(Path(domain).parent)
        problem = ask_to_open(self._parts.window, "Open the problem", near, KINDS)
        if problem:
            self._make(Path(domain), Path(problem))

    def _make(self, domain: Path, problem: Path) -> None:
        def tried() -> Generated | StudioError:
            """Follow all actions, in the worker thread."""
            from smsl_studio.front.generated import generate_pddl

            try:
                return generate_pddl(domain, problem)
            except StudioError as error:
                return error

        self._beside.drop()
        self._parts.toast.offer("Following all actions…", "Cancel", self._beside.drop)
        self._beside.do(tried, self._show)

    def _show(self, came: Generated | StudioError) -> None:
        """Open what was made as a new drawing, which nobody has inspected."""
        if isinstance(came, StudioError):
            self._parts.toast.refuse(came)
            return
        files = self._parts.files
        files.asking.emit()
        if not files.may_leave():
            return
        files.show(OpenedFile(came.blueprint), None, came.blueprint.file)
        self._shell.set_mode("draw")
        goal = "" if came.goal_reached else " The goal cannot be reached."
        states = counted(came.states, "state")
        self._parts.toast.say(f"Made {states}.{goal} Nobody has inspected it yet.")
