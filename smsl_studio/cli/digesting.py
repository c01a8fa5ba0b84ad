"""``digest``: SHA-256 of what a blueprint does, of what is said of it, and of all it needs."""

from __future__ import annotations

import argparse

from smsl_studio.blueprint.digests import digests
from smsl_studio.cli.arguments import Parser, add_format
from smsl_studio.cli.output import Output, one_line, report
from smsl_studio.cli.reading import read_argument
from smsl_studio.errors import ReadError


def add_arguments(parser: Parser) -> None:
    parser.add_argument("files", nargs="+", metavar="FILE", help="a blueprint; - is standard input")
    add_format(parser)


def execute(options: argparse.Namespace, out: Output) -> int:
    found, status = [], 0
    for file in options.files:
        try:
            blueprint = read_argument(file)
        except ReadError as error:
            report(error, "smsl-studio digest")
            status = 2
            continue
        kinds = digests(blueprint).as_json()
        found.append({"file": blueprint.file, **kinds})
        if options.format == "text":
            for kind, digest in kinds.items():
                out.line(f"{digest}  {kind:<9}  {one_line(blueprint.file)}")
    if options.format == "json":
        out.json({"files": found})
    return status
