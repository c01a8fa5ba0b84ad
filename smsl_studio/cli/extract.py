"""``extract``: writes a blueprint in which some states of an SB are a sub-SB of it."""

from __future__ import annotations

import argparse

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.cli.arguments import ArgumentParser
from smsl_studio.cli.output import Output
from smsl_studio.cli.shape_output import add_output, no_shape, write_shape
from smsl_studio.front.shapes import LIMIT, extract
from smsl_studio.generate.shapes.chosen import CutRefused

unanswered = no_shape
"""The JSON for the case that there is no answer."""


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``extract``."""
    parser.add_argument("file", metavar="FILE", help="a blueprint; - is standard input")
    parser.add_argument("--sb", metavar="SB", required=True, help="the SB of the states")
    parser.add_argument(
        "--states", metavar="S,S,...", required=True, help="the states, with commas between them"
    )
    parser.add_argument(
        "--as", metavar="NAME", required=True, dest="name", help="the name of the new sub-SB"
    )
    add_output(parser)


def execute(options: argparse.Namespace, out: Output) -> int:
    """Write it if it behaves as before. Otherwise print the run that shows why not (exit 1)."""
    states = [state.strip() for state in options.states.split(",")]

    def make(blueprint: Blueprint) -> Blueprint:
        """Return the blueprint with the sub-SB."""
        return extract(blueprint, options.sb, states, options.name, options.limit or LIMIT)

    # A name that is already taken is a wrong argument (exit 2). It says nothing about the states.
    return write_shape(options, out, "extract", make, CutRefused)
