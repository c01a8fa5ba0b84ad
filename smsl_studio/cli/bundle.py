"""``bundle``: writes a bundle of evidence, which can be checked without this program."""

from __future__ import annotations

import argparse

from smsl_studio.cli.arguments import ArgumentParser
from smsl_studio.cli.blueprint_argument import inputs_of, read_argument
from smsl_studio.cli.output import Output
from smsl_studio.front.bundles import bundled
from smsl_studio.front.signed_files import SignedPaths
from smsl_studio.smsl.files import save_document


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``bundle``."""
    parser.add_argument("file", metavar="FILE", help="a blueprint; - is standard input")
    parser.add_argument(
        "--log",
        action="append",
        default=[],
        metavar="LOG",
        help="the log of a run of it (run --log); may be repeated",
    )
    parser.add_argument(
        "--record", metavar="RECORD", help="its record (FILE.record.json, if it is there)"
    )
    parser.add_argument("--policy", metavar="FILE", help="the trust policy, a TOML file")
    parser.add_argument(
        "-o", "--output", required=True, metavar="OUT.zip", help="the bundle, OUT.zip"
    )


def execute(options: argparse.Namespace, out: Output) -> int:
    """Write the bundle. It is not checked here; the program verify.py in it does that."""
    blueprint = read_argument(options.file)
    signed = SignedPaths(options.record, options.policy)
    raw = bundled(blueprint, options.output, options.log, signed)
    inputs = [*inputs_of(blueprint), *options.log, *signed.given]
    save_document(raw, options.output, made_of=inputs)
    return 0
