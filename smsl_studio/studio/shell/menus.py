"""The rows of the table of actions: one file for each menu, put together here in their order."""

from __future__ import annotations

from collections.abc import Callable

from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.feature import RunActions, Shell, Supervising
from smsl_studio.studio.document.files.files import Files
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.canvas.clipboard import ClipboardVerbs
from smsl_studio.studio.features.draw.canvas.draw_verbs import DrawVerbs
from smsl_studio.studio.features.draw.compare.comparison import Comparison
from smsl_studio.studio.features.draw.menus.blueprint import blueprint_actions
from smsl_studio.studio.features.draw.menus.compare import compare_actions
from smsl_studio.studio.features.draw.menus.edit import edit_actions
from smsl_studio.studio.features.draw.menus.files import file_actions
from smsl_studio.studio.features.draw.menus.samples import sample_actions
from smsl_studio.studio.features.draw.menus.view import view_actions
from smsl_studio.studio.features.draw.panels.findings import Findings
from smsl_studio.studio.features.people.actions import PeopleActions, people_actions
from smsl_studio.studio.features.replay.actions import replay_actions
from smsl_studio.studio.features.replay.playback import ReplayVerbs
from smsl_studio.studio.features.run.actions import run_actions
from smsl_studio.studio.features.supervise.actions import supervise_actions
from smsl_studio.studio.shell.frame.docks import Docks
from smsl_studio.studio.shell.help_actions import help_actions
from smsl_studio.studio.shell.windows import Windows

__all__ = ["RunActions", "Shell", "all_actions"]


def all_actions(
    shell: Shell,
    session: Session,
    files: Files,
    drawing: DrawVerbs,
    clipping: ClipboardVerbs,
    findings: Findings,
    docks: Docks,
    run: RunActions,
    windows: Windows,
    comparing: Comparison,
    supervise: Supervising,
    people: PeopleActions,
    open_task: Callable[[], object],
    replaying: ReplayVerbs,
) -> tuple[Action, ...]:
    """Every row, menu by menu."""
    return (
        *file_actions(files, session, windows, shell),
        *sample_actions(files),
        *edit_actions(session, drawing, clipping, shell),
        *view_actions(drawing, docks, windows, shell),
        *blueprint_actions(drawing, findings, shell),
        *compare_actions(comparing),
        *run_actions(run, windows, shell),
        *supervise_actions(supervise, shell),
        *people_actions(people, open_task),
        *replay_actions(replaying, windows, shell),
        *help_actions(shell),
    )
