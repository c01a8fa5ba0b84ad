"""The common parts of the commands that change the shape of a blueprint."""

from __future__ import annotations

import argparse
from collections.abc import Callable

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.cli.arguments import ArgumentParser, add_format, add_limit
from smsl_studio.cli.blueprint_argument import inputs_of, read_argument
from smsl_studio.cli.output import Output, note, report_error
from smsl_studio.errors import EditRefused
from smsl_studio.front.outputs import converted, form_of
from smsl_studio.generate.shapes.chosen import CutRefused
from smsl_studio.legible import one_line
from smsl_studio.smsl.files import save_document
from smsl_studio.smsl.forms import SUFFIXES
from smsl_studio.stop import look_for_garbage


def add_output(parser: ArgumentParser, required: bool = True) -> None:
    """Add ``-o OUT``, ``--limit`` and ``--format``."""
    add_limit(parser, "store at most N configurations (default 1,000,000)")
    parser.add_argument(
        "-o",
        "--output",
        metavar="OUT",
        required=required,
        help=f"where it goes; its suffix names the form: {', '.join(SUFFIXES)}",
    )
    add_format(parser)


def save_shape(before: Blueprint, after: Blueprint, output: str) -> None:
    """Write a blueprint to OUT, and say how large it is."""
    made = converted(after, output)
    save_document(made.document, output, made_of=inputs_of(before))
    note(f"{output} has {after.state_count:,} states, {after.operation_count:,} operations.")


def no_shape(reason: str) -> dict[str, object]:
    """Return the JSON for a change of shape that could not be computed."""
    return {"equal": None, "path": [], "reason": reason}


def write_shape(
    options: argparse.Namespace,
    out: Output,
    command: str,
    make: Callable[[Blueprint], Blueprint],
    refusal: type[EditRefused] = EditRefused,
) -> int:
    """Read FILE, and write the result of ``make``. Return the exit status.

    If ``make`` raises ``refusal``, print the reason and the run that shows it, and write nothing
    (exit 1).
    """
    form_of(options.output)
    blueprint = read_argument(options.file)
    look_for_garbage()
    try:
        after = make(blueprint)
    except refusal as error:
        run = error.run if isinstance(error, CutRefused) else ()
        report_error(error, f"smsl-studio {command}")
        if options.format == "json":
            out.json({"equal": False, "path": list(run), "reason": error.sentence})
        elif run:
            out.line(one_line(f"run: {', '.join(run)}"))
        return 1
    save_shape(blueprint, after, options.output)
    if options.format == "json":
        out.json({"equal": True, "path": [], "reason": ""})
    return 0
