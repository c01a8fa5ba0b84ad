"""``fmt``: writes files in the canonical layout. The exit status is 1 if ``--check`` finds another
layout."""

from __future__ import annotations

import argparse

from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.cli.arguments import ArgumentParser, add_format
from smsl_studio.cli.blueprint_argument import note_stand_in, read_argument
from smsl_studio.cli.output import Output, note, note_losses, report_error
from smsl_studio.errors import StudioError, UsageError
from smsl_studio.front.outputs import tidy
from smsl_studio.legible import one_line
from smsl_studio.smsl.document import Document
from smsl_studio.smsl.files import document_of, read_content, save_document
from smsl_studio.smsl.inputs import Seen

STDIN = "-"


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``fmt``."""
    parser.add_argument(
        "files",
        nargs="+",
        metavar="FILE",
        help="a blueprint; - is standard input, and goes to standard output",
    )
    parser.add_argument(
        "--check", action="store_true", help="write nothing; name the files that would change"
    )
    add_format(parser)


def execute(options: argparse.Namespace, out: Output) -> int:
    """Lay out each file. 0: done; 1: ``--check`` found another layout; 2: an error in a file."""
    as_json = options.format == "json"
    if as_json and not options.check and STDIN in options.files:
        raise UsageError(
            "what - is laid out to goes to standard output, where the report would stand, too",
            advice="Leave out --format json, or name a file.",
        )
    status = 0
    reports = []
    for file in options.files:
        try:
            document, over = _read(file)
            tidied = tidy(document)
            changed = tidied.text != document.text
            if not options.check:
                _write(document, tidied, over, out)
        except StudioError as error:
            report_error(error, "smsl-studio fmt")
            status = 2
            continue
        reports.append({"file": document.file, "changed": changed})
        if options.check and changed:
            status = max(status, 1)
            if not as_json:
                out.line(one_line(document.file))
    if as_json:
        out.json({"files": reports})
    return status


def _read(file: str) -> tuple[Document, Seen | None]:
    """Return the document in a file, and the state of the file that a save must find. The state is
    None for standard input."""
    if file == STDIN:
        return read_argument(file).document, None
    content = read_content(file)
    document = document_of(content, file)
    read_blueprint(document)
    if content.stands_in:
        note_stand_in(file, content.stands_in)
    return document, content.seen


def _write(document: Document, tidied: Document, over: Seen | None, out: Output) -> None:
    """Print the new layout of standard input, or save a file if its layout changes."""
    if over is None:
        out.text(tidied.text)
    elif tidied.text != document.text:
        note_losses(document.file)
        save_document(tidied, document.file, over)
        note(f"{document.file}: laid out anew")
