"""``flatten``: writes a blueprint as one SB that behaves alike."""

from __future__ import annotations

import argparse

from smsl_studio.cli.arguments import ArgumentParser, add_limit
from smsl_studio.cli.blueprint_argument import inputs_of, read_argument
from smsl_studio.cli.output import Output, note
from smsl_studio.front.outputs import converted, form_of
from smsl_studio.front.shapes import LIMIT, flatten
from smsl_studio.smsl.files import save_document
from smsl_studio.smsl.forms import SUFFIXES


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``flatten``."""
    parser.add_argument("file", metavar="FILE", help="a blueprint; - is standard input")
    parser.add_argument("--sb", metavar="SB", help="only this SB and all below it")
    add_limit(parser, "store at most N configurations (default 1,000,000)")
    parser.add_argument(
        "-o",
        "--output",
        metavar="OUT",
        required=True,
        help=f"where it goes; its suffix names the form: {', '.join(SUFFIXES)}",
    )


def execute(options: argparse.Namespace, out: Output) -> int:
    """Write the flat blueprint. RunRefused or PlanningError (exit 1) if there is none."""
    form_of(options.output)
    blueprint = read_argument(options.file)
    flat = flatten(blueprint, options.sb, options.limit or LIMIT)
    made = converted(flat, options.output)
    save_document(made.document, options.output, made_of=inputs_of(blueprint))
    note(f"{options.output} has {flat.state_count:,} states, {flat.operation_count:,} operations.")
    return 0
