"""The rows of the table of actions: one file for each menu, put together here in their order."""

from __future__ import annotations

from collections.abc import Callable

from smsl_studio.studio.actions import Action
from smsl_studio.studio.clipboard import ClipboardVerbs
from smsl_studio.studio.commands.blueprint import blueprint_actions
from smsl_studio.studio.commands.compare import compare_actions
from smsl_studio.studio.commands.edit import edit_actions
from smsl_studio.studio.commands.files import file_actions
from smsl_studio.studio.commands.help import help_actions
from smsl_studio.studio.commands.people import PeopleActions, people_actions
from smsl_studio.studio.commands.replay import replay_actions
from smsl_studio.studio.commands.run import run_actions
from smsl_studio.studio.commands.samples import sample_actions
from smsl_studio.studio.commands.shell import RunActions, Shell, Supervising
from smsl_studio.studio.commands.supervise import supervise_actions
from smsl_studio.studio.commands.view import view_actions
from smsl_studio.studio.compare.comparison import Comparison
from smsl_studio.studio.draw_verbs import DrawVerbs
from smsl_studio.studio.files.files import Files
from smsl_studio.studio.frame.docks import Docks
from smsl_studio.studio.panels.findings import Findings
from smsl_studio.studio.replay.playback import ReplayVerbs
from smsl_studio.studio.session import Session
from smsl_studio.studio.windows import Windows

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
