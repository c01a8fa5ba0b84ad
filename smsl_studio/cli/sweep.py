"""``sweep``: runs every edge alone in a world. The exit status is 0 if all edges pass."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from smsl_studio.cli.arguments import (
    ArgumentParser,
    add_format,
    add_robot,
    add_seed_and_host,
    add_world,
    host_of,
)
from smsl_studio.cli.blueprint_argument import read_argument
from smsl_studio.cli.output import Output, note
from smsl_studio.cli.story import line_of
from smsl_studio.legible import one_line
from smsl_studio.runlog.events import SweepFinished
from smsl_studio.stop import look_for_garbage

if TYPE_CHECKING:
    from smsl_studio.library.generated_trials import FunctionTrial


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``sweep``."""
    parser.add_argument("file", metavar="FILE", help="a blueprint; - is standard input")
    add_world(parser, required=True)
    add_robot(parser)
    add_seed_and_host(parser)
    parser.add_argument(
        "--sb", action="append", metavar="SB", help="only this State Branch; may be repeated"
    )
    parser.add_argument(
        "--operation", action="append", metavar="NAME", help="only this operation; may be repeated"
    )
    parser.add_argument(
        "--most",
        type=_count,
        metavar="N",
        help="so many operations at most (default 2,500, fewer where checks are large)",
    )
    add_format(parser)


def execute(options: argparse.Namespace, out: Output) -> int:
    """Run every edge alone and print the results. 0: all edges pass; 1: some do not."""
    from smsl_studio.front.sweeps import sweep

    blueprint = read_argument(options.file)
    look_for_garbage()
    status = 1
    events = sweep(
        blueprint,
        options.world,
        seed=options.seed,
        host=host_of(options),
        branches=options.sb or (),
        most=options.most,
        robot=options.robot,
        operations=options.operation or (),
        tried=_note,
    )
    for event in events:
        out.line(event.line() if options.format == "json" else one_line(line_of(event)))
        if isinstance(event, SweepFinished):
            status = 0 if event.passed == event.edges else 1
    return status


def _note(trial: FunctionTrial) -> None:
    """Say what became of a generated function."""
    what = f"the generated function of {trial.operation}"
    if trial.passed:
        note(one_line(f"{what} has passed its sweep, and is offered in {trial.world}"))
    else:
        note(one_line(f"{what} is not offered in {trial.world}: {trial.sentence}"))


def _count(text: str) -> int:
    if not (text.isascii() and text.isdecimal() and 0 < len(text) < 10):
        raise argparse.ArgumentTypeError(f"{text!r} is no number of operations")
    return int(text)
