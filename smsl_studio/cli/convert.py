"""``convert``: writes a blueprint in another form, or as a diagram for other programs. The suffix
of the new file names which."""

from __future__ import annotations

import argparse

from smsl_studio.blueprint.imported_files import KEY as IMPORTS
from smsl_studio.cli.arguments import ArgumentParser
from smsl_studio.cli.blueprint_argument import inputs_of, read_argument
from smsl_studio.cli.output import Output, note, note_losses
from smsl_studio.front.outputs import DIAGRAMS, converted, diagram, form_of, is_diagram
from smsl_studio.smsl.document import WORDS
from smsl_studio.smsl.files import save_document
from smsl_studio.smsl.forms import SUFFIXES


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``convert``."""
    parser.add_argument("file", metavar="FILE", help="a blueprint; - is standard input")
    parser.add_argument(
        "-o",
        "--output",
        metavar="OUT",
        required=True,
        help=f"where it goes; its suffix names the form: {', '.join((*SUFFIXES, *DIAGRAMS))}",
    )


def execute(options: argparse.Namespace, out: Output) -> int:
    """Write the blueprint in the form of the suffix. UsageError for an unknown suffix."""
    if is_diagram(options.output):
        return _draw(options)
    form = form_of(options.output, DIAGRAMS)
    blueprint = read_argument(options.file)
    made = converted(blueprint, options.output)
    note_losses(options.output)
    save_document(made.document, options.output, made_of=inputs_of(blueprint))
    if left := made.comments_left:
        words = "1 comment was" if left == 1 else f"{left} comments were"
        note(f"{words} left behind: {WORDS[form]} has no place for comments.")
    if made.document.values.get(IMPORTS) != blueprint.document.values.get(IMPORTS):
        note(f"_imports are named from the folder of {options.output}.")
    return 0


def _draw(options: argparse.Namespace) -> int:
    """Write a diagram, and say that it is no blueprint."""
    blueprint = read_argument(options.file)
    text = diagram(blueprint, options.output)
    save_document(text, options.output, made_of=inputs_of(blueprint))
    note(f"{options.output} has states and operations alone. It cannot be read back.")
    return 0
