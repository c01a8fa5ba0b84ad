"""``convert``: writes a blueprint in another form, or for other programs, or reads theirs. The
suffixes of the files name which."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from typing import TYPE_CHECKING

from smsl_studio.blueprint.imported_files import KEY as IMPORTS
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.cli.arguments import ArgumentParser, add_format
from smsl_studio.cli.blueprint_argument import inputs_of, read_argument
from smsl_studio.cli.output import Output, note, note_losses
from smsl_studio.exchange.table import WRITTEN
from smsl_studio.front.exchanges import exported, imported, is_exported, is_imported
from smsl_studio.front.outputs import converted, form_of
from smsl_studio.smsl.document import WORDS
from smsl_studio.smsl.files import save_document
from smsl_studio.smsl.forms import SUFFIXES

if TYPE_CHECKING:
    from smsl_studio.exchange.findings import ExchangeFinding


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``convert``."""
    words = "a blueprint, or a file of another program; - is standard input"
    parser.add_argument("file", metavar="FILE", help=words)
    parser.add_argument(
        "-o",
        "--output",
        metavar="OUT",
        required=True,
        help=f"where it goes; its suffix names the form: {', '.join((*SUFFIXES, *WRITTEN))}",
    )
    add_format(parser)


def execute(options: argparse.Namespace, out: Output) -> int:
    """Write the blueprint in the form of the suffix. UsageError for an unknown suffix."""
    if not is_exported(options.output):
        form_of(options.output, WRITTEN)
    findings: list[ExchangeFinding] = []
    if options.file != "-" and is_imported(options.file):
        blueprint, told = imported(options.file)
        findings.extend(told)
    else:
        blueprint = read_argument(options.file)
    if is_exported(options.output):
        made = exported(blueprint, options.output)
        findings.extend(made.findings)
        note_losses(options.output)
        save_document(made.text, options.output, made_of=inputs_of(blueprint))
    else:
        _write(blueprint, options.output)
    _tell(options, findings, out)
    return 0


def _write(blueprint: Blueprint, output: str) -> None:
    """Write a blueprint in a form of SMSL."""
    made = converted(blueprint, output)
    note_losses(output)
    save_document(made.document, output, made_of=inputs_of(blueprint))
    if left := made.comments_left:
        words = "1 comment was" if left == 1 else f"{left} comments were"
        form = WORDS[form_of(output)]
        note(f"{words} left behind: {form} has no place for comments.")
    if made.document.values.get(IMPORTS) != blueprint.document.values.get(IMPORTS):
        note(f"_imports are named from the folder of {output}.")


def _tell(options: argparse.Namespace, findings: Sequence[ExchangeFinding], out: Output) -> None:
    """Tell what the form does not hold: on standard error, or as JSON."""
    if options.format == "json":
        told = [one.plain for one in findings]
        out.json({"file": options.file, "output": options.output, "findings": told})
        return
    for one in findings:
        place = f"{options.file}:{one.line}:{one.column}: " if one.line else ""
        note(f"{place}{one.address}: {one.message}" if one.address else f"{place}{one.message}")
