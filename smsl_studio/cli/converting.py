"""``convert``: the same blueprint in another written form, by the suffix of the file it goes to."""

from __future__ import annotations

import argparse
import os
from pathlib import Path

from smsl_studio.cli.arguments import Parser
from smsl_studio.cli.output import Output, note, one_line
from smsl_studio.cli.reading import read_argument
from smsl_studio.errors import UsageError
from smsl_studio.smsl.converting import convert
from smsl_studio.smsl.files import save_document
from smsl_studio.smsl.forms import SUFFIXES, WORDS


def add_arguments(parser: Parser) -> None:
    parser.add_argument("file", metavar="FILE", help="a blueprint; - is standard input")
    parser.add_argument(
        "-o",
        "--output",
        metavar="OUT",
        required=True,
        help=f"where it goes; its suffix names the form: {', '.join(SUFFIXES)}",
    )


def execute(options: argparse.Namespace, out: Output) -> int:
    form = SUFFIXES.get(Path(options.output).suffix.lower())
    if form is None:
        raise UsageError(
            f"the suffix of {options.output} names no written form",
            advice=f"End it with {', '.join(SUFFIXES)}.",
        )
    document = read_argument(options.file).document
    converted = convert(document, form, options.output)
    save_document(converted.document, options.output)
    if left := converted.comments_left:
        words = "1 comment was" if left == 1 else f"{left} comments were"
        note(f"{words} left behind: {WORDS[form]} has no place for comments.")
    if document.values.get("_imports") and _folder(document.file) != _folder(options.output):
        name = one_line(options.output)
        note(f"{name} stands in another folder, and _imports are named from the file's own.")
    return 0


def _folder(file: str) -> Path:
    return Path(os.path.realpath(file)).parent
