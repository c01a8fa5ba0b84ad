"""``inline``: writes a blueprint in which a sub-SB and its base are one SB."""

from __future__ import annotations

import argparse

from smsl_studio.cli.arguments import ArgumentParser
from smsl_studio.cli.output import Output
from smsl_studio.cli.shape_output import add_output, no_shape, write_shape
from smsl_studio.front.shapes import LIMIT, inline

unanswered = no_shape
"""The JSON for the case that there is no answer."""


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``inline``."""
    parser.add_argument("file", metavar="FILE", help="a blueprint; - is standard input")
    parser.add_argument(
        "--sb", metavar="SUB", required=True, help="the sub-SB that goes into its base"
    )
    add_output(parser)


def execute(options: argparse.Namespace, out: Output) -> int:
    """Write it if it behaves as before. Otherwise print the run that shows why not (exit 1)."""
    return write_shape(
        options, out, "inline",
        lambda blueprint: inline(blueprint, options.sb, options.limit or LIMIT),
    )  # fmt: skip
