"""The command line: one small file for each command, loaded only when that command is given.

Exit status: 0 good, 1 the answer is no, 2 wrong usage or an input that cannot be read; 128 and the
number of the signal (130 for Ctrl-C, 143 for SIGTERM) where the command was stopped.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Mapping, Sequence
from importlib import import_module
from types import ModuleType
from typing import Any

from smsl_studio.cli.arguments import COMMANDS, ArgumentParser, overview
from smsl_studio.cli.output import Output, claimed_stdout, last_note, lead_nowhere, report_error
from smsl_studio.cli.secrets_apart import secrets_apart
from smsl_studio.cli.signals import Signals, heard
from smsl_studio.errors import (
    ApprovalRefused,
    PlanningError,
    RunRefused,
    StudioError,
    UsageError,
    did_you_mean,
)
from smsl_studio.stop import let_garbage_be

__all__ = ["main", "program"]


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command and return its exit status. Expected errors are printed as sentences."""
    arguments = list(sys.argv[1:] if argv is None else argv)
    with heard() as signals:
        return _stoppable(arguments, signals)


def program(argv: Sequence[str]) -> int:
    """Run one command in a process of its own. A stopped command ends the process at once."""
    let_garbage_be()
    with heard() as signals:
        return _stoppable(argv, signals, os._exit)


def _stoppable(
    arguments: Sequence[str], signals: Signals, leave: Callable[[int], object] | None = None
) -> int:
    """Run one command until it ends or is stopped. Return its exit status.

    After a stop ``leave`` ends the process while the memory of the work is still in use, because to
    free all of it would take longer than the stop.
    """
    name = _name(arguments)
    try:
        status = _told(arguments, name, signals)
        signals.close()
    except KeyboardInterrupt:
        signals.close()
        last_note(f"{name}: stopped")
        status = signals.status
        if leave is not None:
            leave(status)
    if leave is not None and signals.asked:
        leave(status)
    return status


def _told(arguments: Sequence[str], name: str, signals: Signals) -> int:
    """Run one command and report its errors. Return the exit status."""
    try:
        with claimed_stdout() as stream:
            try:
                return _dispatch(arguments, Output(stream), signals)
            except SystemExit as end:  # argparse has printed its help
                return end.code if isinstance(end.code, int) else 2
            except (ApprovalRefused, PlanningError, RunRefused) as error:
                report_error(error, name)
                return 1
            except StudioError as error:
                report_error(error, name)
                return 2
    except BrokenPipeError:
        lead_nowhere(sys.stdout)  # so that the interpreter does not fail at its last flush
        return 1


def _name(arguments: Sequence[str]) -> str:
    known = bool(arguments) and arguments[0] in COMMANDS
    return f"smsl-studio {arguments[0]}" if known else "smsl-studio"


def _dispatch(arguments: Sequence[str], out: Output, signals: Signals) -> int:
    if not arguments or arguments[0] in ("-h", "--help"):
        out.line(overview())
        return 0
    name, *rest = arguments
    if name in ("-V", "--version"):
        from smsl_studio.front.version import version

        out.line(f"smsl-studio {version()}")
        return 0
    if name not in COMMANDS:
        what = "option" if name.startswith("-") else "command"
        raise UsageError(
            f"there is no {what} {name!r}",
            advice=did_you_mean(name, COMMANDS) or "smsl-studio --help lists what there is.",
        )
    module = import_module(f"smsl_studio.cli.{name.replace('-', '_')}")
    parser = ArgumentParser(name, out)
    module.add_arguments(parser)
    options = parser.parse_args(rest)
    options.signals = signals
    try:
        with secrets_apart() as options.secrets:
            status: int = module.execute(options, out)
    except (RunRefused, PlanningError) as error:
        if getattr(options, "format", "") == "json":
            out.json(_unanswered(module, error.sentence))
        raise
    return status


def _unanswered(module: ModuleType, reason: str) -> Mapping[str, Any]:
    """Return the JSON of a command that has no answer, with the reason.

    The command's module may define the keys of this JSON.
    """
    of_command: Callable[[str], Mapping[str, Any]] | None = getattr(module, "unanswered", None)
    return {"reason": reason} if of_command is None else of_command(reason)
