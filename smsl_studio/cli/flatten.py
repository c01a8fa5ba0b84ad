"""``flatten``: writes a blueprint as one SB that behaves alike."""

from __future__ import annotations

import argparse

from smsl_studio.cli.arguments import ArgumentParser
from smsl_studio.cli.output import Output
from smsl_studio.cli.shape_output import add_output, no_shape, write_shape
from smsl_studio.front.shapes import LIMIT, flatten

unanswered = no_shape
"""The JSON for the case that there is no answer."""


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``flatten``."""
    parser.add_argument("file", metavar="FILE", help="a blueprint; - is standard input")
    parser.add_argument("--sb", metavar="SB", help="only this SB and all below it")
    add_output(parser)


def execute(options: argparse.Namespace, out: Output) -> int:
    """Write the flat blueprint. RunRefused or PlanningError (exit 1) if there is none."""
    return write_shape(
        options, out, "flatten",
        lambda blueprint: flatten(blueprint, options.sb, options.limit or LIMIT),
    )  # fmt: skip
