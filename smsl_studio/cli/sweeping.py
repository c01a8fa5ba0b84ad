"""``sweep``: every edge by itself in a world. Exit status 0 where all of them pass."""

from __future__ import annotations

import argparse

from smsl_studio.cli.arguments import (
    Parser,
    add_format,
    add_seed_and_host,
    add_world,
    host_of,
)
from smsl_studio.cli.output import Output, one_line
from smsl_studio.cli.reading import read_argument
from smsl_studio.cli.story import line_of
from smsl_studio.runlog.events import SweepFinished


def add_arguments(parser: Parser) -> None:
    parser.add_argument("file", metavar="FILE", help="a blueprint; - is standard input")
    add_world(parser, required=True)
    add_seed_and_host(parser)
    add_format(parser)


def execute(options: argparse.Namespace, out: Output) -> int:
    from smsl_studio.front.sweeping import sweep

    blueprint = read_argument(options.file)
    status = 1
    for event in sweep(blueprint, options.world, seed=options.seed, host=host_of(options)):
        out.line(event.line() if options.format == "json" else one_line(line_of(event)))
        if isinstance(event, SweepFinished):
            status = 0 if event.passed == event.edges else 1
    return status
