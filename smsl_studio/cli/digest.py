"""``digest``: prints the SHA-256 digests of a blueprint: of its behaviour, of its annotations, and
of both with imported files."""

from __future__ import annotations

import argparse

from smsl_studio.cli.arguments import ArgumentParser, add_format
from smsl_studio.cli.blueprint_argument import read_each
from smsl_studio.cli.output import Output
from smsl_studio.errors import ReadError
from smsl_studio.front.outputs import digest
from smsl_studio.legible import one_line


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``digest``."""
    parser.add_argument("files", nargs="+", metavar="FILE", help="a blueprint; - is standard input")
    add_format(parser)


def execute(options: argparse.Namespace, out: Output) -> int:
    """Print the three digests of each file. 0: all were read; 2: some could not be read."""
    found, status = [], 0
    for blueprint in read_each(options.files, "smsl-studio digest"):
        if isinstance(blueprint, ReadError):
            status = 2
            continue
        kinds = digest(blueprint).as_json()
        found.append({"file": blueprint.file, **kinds})
        if options.format == "text":
            for kind, value in kinds.items():
                out.line(f"{value}  {kind:<9}  {one_line(blueprint.file)}")
    if options.format == "json":
        out.json({"files": found})
    return status
