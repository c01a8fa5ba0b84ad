"""The rows of the table of actions: one file for each menu, put together here in their order."""

from __future__ import annotations

from collections.abc import Callable

from smsl_studio.studio.actions import Action
from smsl_studio.studio.clipping import Clipping
from smsl_studio.studio.commands.blueprint import blueprint_actions
from smsl_studio.studio.commands.compare import compare_actions
from smsl_studio.studio.commands.edit import edit_actions
from smsl_studio.studio.commands.files import file_actions
from smsl_studio.studio.commands.help import help_actions
from smsl_studio.studio.commands.people import Asking, people_actions
from smsl_studio.studio.commands.replay import replay_actions
from smsl_studio.studio.commands.run import run_actions
from smsl_studio.studio.commands.samples import sample_actions
from smsl_studio.studio.commands.shell import Shell, Supervising, Transport
from smsl_studio.studio.commands.supervise import supervise_actions
from smsl_studio.studio.commands.view import view_actions
from smsl_studio.studio.compare.comparing import Comparing
from smsl_studio.studio.drawing import Drawing
from smsl_studio.studio.files.files import Files
from smsl_studio.studio.frame.docks import Docks
from smsl_studio.studio.panels.findings import Findings
from smsl_studio.studio.replay.replaying import Replaying
from smsl_studio.studio.session import Session
from smsl_studio.studio.windows import Windows

__all__ = ["Shell", "Transport", "all_actions"]


def all_actions(
    shell: Shell,
    session: Session,
    files: Files,
    drawing: Drawing,
    clipping: Clipping,
    findings: Findings,
    docks: Docks,
    run: Transport,
    windows: Windows,
    comparing: Comparing,
    supervise: Supervising,
    people: Asking,
    open_task: Callable[[], object],
    replaying: Replaying,
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
