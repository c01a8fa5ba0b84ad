"""``render``: a picture of a blueprint, without a display."""

from __future__ import annotations

import argparse

from smsl_studio.cli.arguments import ArgumentParser
from smsl_studio.cli.blueprint_argument import inputs_of, read_argument
from smsl_studio.cli.output import Output
from smsl_studio.cli.pictures import add_picture, draw_picture, picture_form
from smsl_studio.errors import UsageError
from smsl_studio.smsl.files import save_document


def add_arguments(parser: ArgumentParser) -> None:
    """The arguments of ``render``."""
    parser.add_argument("file", metavar="FILE", help="a blueprint; - is standard input")
    add_picture(parser, required=True)
    parser.add_argument(
        "--sb", action="append", metavar="SB", help="only this State Branch; may be repeated"
    )
    parser.add_argument(
        "--theme", choices=("light", "dark"), default="light", help="light (default) or dark"
    )


def execute(options: argparse.Namespace, out: Output) -> int:
    """Draw the chosen SBs into a file; UsageError where there is none to draw."""
    from smsl_studio.picture.colours import DARK, LIGHT
    from smsl_studio.picture.svg import draw_blueprint

    picture_form(options.output)
    blueprint = read_argument(options.file)
    chosen = [blueprint[name].name for name in options.sb or blueprint.branches]
    if not chosen:
        raise UsageError(
            f"{blueprint.file} has no State Branch to draw", advice="Name another file."
        )
    colours = DARK if options.theme == "dark" else LIGHT
    panels = draw_blueprint(blueprint, list(dict.fromkeys(chosen)), colours)
    picture = draw_picture(panels, blueprint.file, options.output, colours)
    save_document(picture, options.output, made_of=inputs_of(blueprint))
    return 0
