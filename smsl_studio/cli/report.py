"""``report``: writes the reading of a blueprint for people, as HTML or PDF."""

from __future__ import annotations

import argparse

from smsl_studio.cli.arguments import ArgumentParser, add_format
from smsl_studio.cli.blueprint_argument import read_argument
from smsl_studio.cli.output import Output, note
from smsl_studio.front.readings import READERS
from smsl_studio.front.reports import report, report_form


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``report``."""
    parser.add_argument("file", metavar="FILE", help="a blueprint; - is standard input")
    parser.add_argument(
        "-o", "--output", required=True, metavar="OUT", help="the report: .html or .pdf"
    )
    parser.add_argument(
        "--against", metavar="RECORD", help="a signed record: tell what has changed since"
    )
    parser.add_argument(
        "--for",
        dest="reader",
        choices=READERS,
        default=READERS[0],
        help="clinician (default), or engineer: with the names in the file",
    )
    add_format(parser)


def execute(options: argparse.Namespace, out: Output) -> int:
    """Write the report. It says what it could not tell, and how many points are open."""
    report_form(options.output)
    blueprint = read_argument(options.file)
    told = report(blueprint, options.output, options.against, options.reader)
    if told.untitled.sentence:
        note(f"{told.untitled.sentence}; the report can only count them")
    if options.format == "json":
        out.json(told.as_json())
        return 0
    lines = sum(len(section.lines) for section in told.sections)
    many = told.open_points
    out.line(f"{lines:,} lines, {many:,} of them {'is' if many == 1 else 'are'} open")
    return 0
