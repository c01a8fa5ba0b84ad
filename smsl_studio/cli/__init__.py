"""The command line: one small file a command, loaded only when it is the one.

Exit status: 0 good, 1 the answer is no, 2 wrong usage or an input that cannot be read.
"""

from __future__ import annotations

import contextlib
import os
import sys
from collections.abc import Sequence
from importlib import import_module

from smsl_studio.cli.arguments import COMMANDS, Parser, overview
from smsl_studio.cli.output import Output, claimed_stdout, note, report
from smsl_studio.errors import PlanningError, RunRefused, StudioError, UsageError, did_you_mean

__all__ = ["main"]


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command; its exit status. Expected errors are sentences, never tracebacks."""
    arguments = list(sys.argv[1:] if argv is None else argv)
    name = "smsl-studio"
    try:
        with claimed_stdout() as stream:
            try:
                if arguments and arguments[0] in COMMANDS:
                    name = f"smsl-studio {arguments[0]}"
                return _dispatch(arguments, Output(stream))
            except SystemExit as end:  # argparse has printed its help
                return end.code if isinstance(end.code, int) else 2
            except (RunRefused, PlanningError) as error:
                report(error, name)
                return 1
            except StudioError as error:
                report(error, name)
                return 2
    except BrokenPipeError:
        _nobody_listens()
        return 1
    except KeyboardInterrupt:
        note(f"{name}: interrupted")
        return 1


def _dispatch(arguments: list[str], out: Output) -> int:
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
    module = import_module(f"smsl_studio.cli.{COMMANDS[name].module}")
    parser = Parser(name, out)
    module.add_arguments(parser)
    status: int = module.execute(parser.parse_args(rest), out)
    return status


def _nobody_listens() -> None:
    """Whoever read our output has gone: keep the interpreter from failing at its last flush."""
    with contextlib.suppress(OSError, ValueError, AttributeError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
