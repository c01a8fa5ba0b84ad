"""``flatten``: writes a blueprint as one SB that behaves alike."""

from __future__ import annotations

import argparse

from smsl_studio.cli.arguments import ArgumentParser
from smsl_studio.cli.blueprint_argument import read_argument
from smsl_studio.cli.output import Output
from smsl_studio.cli.shape_output import add_output, save_shape, tell_alike, tell_refusal
from smsl_studio.errors import EditRefused
from smsl_studio.front.outputs import form_of
from smsl_studio.front.shapes import LIMIT, flatten
from smsl_studio.stop import look_for_garbage


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``flatten``."""
    parser.add_argument("file", metavar="FILE", help="a blueprint; - is standard input")
    parser.add_argument("--sb", metavar="SB", help="only this SB and all below it")
    add_output(parser)


def execute(options: argparse.Namespace, out: Output) -> int:
    """Write the flat blueprint. RunRefused or PlanningError (exit 1) if there is none."""
    form_of(options.output)
    blueprint = read_argument(options.file)
    look_for_garbage()
    try:
        flat = flatten(blueprint, options.sb, options.limit or LIMIT)
    except EditRefused as error:
        return tell_refusal(error, "flatten", options, out)
    save_shape(blueprint, flat, options.output)
    return tell_alike(options, out)
