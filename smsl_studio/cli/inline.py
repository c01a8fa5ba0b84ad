"""``inline``: writes a blueprint in which a sub-SB and its base are one SB."""

from __future__ import annotations

import argparse

from smsl_studio.cli.arguments import ArgumentParser
from smsl_studio.cli.blueprint_argument import read_argument
from smsl_studio.cli.output import Output
from smsl_studio.cli.shape_output import add_output, save_shape, tell_alike, tell_refusal
from smsl_studio.errors import EditRefused
from smsl_studio.front.outputs import form_of
from smsl_studio.front.shapes import LIMIT, inline
from smsl_studio.stop import look_for_garbage


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``inline``."""
    parser.add_argument("file", metavar="FILE", help="a blueprint; - is standard input")
    parser.add_argument(
        "--sb", metavar="SUB", required=True, help="the sub-SB that goes into its base"
    )
    add_output(parser)


def execute(options: argparse.Namespace, out: Output) -> int:
    """Write it if it behaves as before. Otherwise print the run that shows why not (exit 1)."""
    form_of(options.output)
    blueprint = read_argument(options.file)
    look_for_garbage()
    try:
        after = inline(blueprint, options.sb, options.limit or LIMIT)
    except EditRefused as error:
        return tell_refusal(error, "inline", options, out)
    save_shape(blueprint, after, options.output)
    return tell_alike(options, out)
