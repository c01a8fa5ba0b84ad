"""``render``: draws a picture of a blueprint. It needs no display."""

from __future__ import annotations

import argparse

from smsl_studio.cli.arguments import ArgumentParser, add_picture
from smsl_studio.cli.blueprint_argument import inputs_of, read_argument
from smsl_studio.cli.output import Output
from smsl_studio.front.outputs import THEMES, drawn, picture_form
from smsl_studio.smsl.files import save_document


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``render``."""
    parser.add_argument("file", metavar="FILE", help="a blueprint; - is standard input")
    add_picture(parser, required=True)
    parser.add_argument(
        "--sb", action="append", metavar="SB", help="only this State Branch; may be repeated"
    )
    parser.add_argument(
        "--map",
        action="store_true",
        help="the whole file: all State Branches as cards, and which fact leads to which sub-SB",
    )
    parser.add_argument(
        "--collapse",
        action="store_true",
        help="draw operations between the same two states as one line with their number",
    )
    parser.add_argument("--theme", choices=THEMES, default="light", help="light (default) or dark")


def execute(options: argparse.Namespace, out: Output) -> int:
    """Draw the chosen SBs, or the map of all, into a file. UsageError if there is no SB."""
    picture_form(options.output)
    blueprint = read_argument(options.file)
    chosen = options.sb or ()
    picture = drawn(blueprint, options.output, chosen, options.theme, options.map, options.collapse)
    save_document(picture, options.output, made_of=inputs_of(blueprint))
    return 0
