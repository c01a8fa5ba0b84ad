"""``generate``: makes a blueprint instead of drawing it. ``generate rules`` makes it of rules."""

from __future__ import annotations

import argparse

from smsl_studio.cli.arguments import ArgumentParser, add_format
from smsl_studio.cli.output import Output, note
from smsl_studio.legible import one_line
from smsl_studio.smsl.files import save_document


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``generate``."""
    parser.add_argument("what", choices=("rules",), help="what it is made of")
    parser.add_argument("file", metavar="RULES.toml", help="the rules")
    parser.add_argument(
        "-o", "--output", required=True, metavar="OUT", help="the blueprint: .json, .smsl, .yaml"
    )
    add_format(parser)


def execute(options: argparse.Namespace, out: Output) -> int:
    """Write the blueprint. 0: it is written; 1: it is, and its goal cannot be reached."""
    from smsl_studio.front.generated import generate_rules
    from smsl_studio.front.outputs import converted

    made = generate_rules(options.file)
    document = converted(made.blueprint, options.output).document
    save_document(document, options.output, made_of=[options.file])
    if options.format == "json":
        out.json({"states": made.states, "operations": made.operations, "goal": made.goal_reached})
    else:
        words = f"{options.output}: {made.states:,} states, {made.operations:,} operations"
        out.line(one_line(words))
    if not made.goal_reached:
        note("the goal cannot be reached with these rules; ACTIVATING is left out")
    return 0 if made.goal_reached else 1
