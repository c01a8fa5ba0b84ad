"""``preview``: what a simulated world predicts for one operation. The exit status is 0 if it agrees
with the blueprint."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from smsl_studio.cli.arguments import ArgumentParser, add_format, add_robot, add_world
from smsl_studio.cli.blueprint_argument import read_argument
from smsl_studio.cli.output import Output
from smsl_studio.errors import UsageError
from smsl_studio.legible import one_line
from smsl_studio.stop import look_for_garbage

if TYPE_CHECKING:
    from smsl_studio.front.forecasts import Forecast


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``preview``."""
    parser.add_argument("file", metavar="FILE", help="a blueprint; - is standard input")
    add_world(parser, required=True)
    add_robot(parser)
    parser.add_argument("--edge", required=True, metavar="SB/State/Op", help="the operation")
    parser.add_argument(
        "--start",
        action="append",
        metavar="SB/State",
        help="where to begin; one an SB (default: the source of the operation)",
    )
    parser.add_argument("--log", metavar="LOG", help="begin in the last configuration of a log")
    parser.add_argument(
        "--horizon", type=_count, default=1, metavar="N", help="so many operations of the route"
    )
    parser.add_argument(
        "--repeats", type=_count, default=1, metavar="K", help="try it with K seeds"
    )
    parser.add_argument(
        "--seed", type=_seed, default=0, metavar="S", help="the first seed (default 0)"
    )
    add_format(parser)


def execute(options: argparse.Namespace, out: Output) -> int:
    """Carry the operation out in a simulated world, and print the facts. 0: it agrees."""
    from smsl_studio.front.previews import preview

    if options.start and options.log:
        raise UsageError("--start and --log both say where to begin", advice="Name one of them.")
    blueprint = read_argument(options.file)
    look_for_garbage()
    told = preview(
        blueprint,
        options.edge,
        options.world,
        start=options.start,
        log=options.log,
        ahead=options.horizon,
        repeats=options.repeats,
        seed=options.seed,
        robot=options.robot,
    )
    if options.format == "json":
        out.json(told.as_json())
    else:
        for one in (told, *told.then):
            _print(one, out)
        if options.repeats > 1:
            out.line(f"{100 * told.share:.0f} % of {options.repeats} repeats agree")
    return 0 if told.agrees and told.share == 1.0 else 1


def _print(told: Forecast, out: Output) -> None:
    verdict = "agrees" if told.agrees else "differs"
    out.line(one_line(f"{told.edge}: {verdict}"))
    for fact, value in told.after.items():
        before, declared = told.before.get(fact), told.declared.get(fact)
        if value != before or value != declared:
            said = "" if value == declared else f", declared {declared}"
            out.line(one_line(f"    {fact}: {before} to {value or 'unknown'}{said}"))
    for words in (told.sentence, told.hazard and f"hazard {told.hazard}"):
        if words:
            out.line(one_line(f"    {words}"))


def _count(text: str) -> int:
    if not (text.isascii() and text.isdecimal() and 0 < len(text) < 6 and int(text)):
        raise argparse.ArgumentTypeError(f"{text!r} is no whole number from 1 up")
    return int(text)


def _seed(text: str) -> int:
    if not (text.isascii() and text.isdecimal() and len(text) < 19):
        raise argparse.ArgumentTypeError(f"{text!r} is no whole number from 0 up")
    return int(text)
