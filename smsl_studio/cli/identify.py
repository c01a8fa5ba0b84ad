"""``identify``: lists the states that could be a sub-SB. The exit status is 1 if there are none."""

from __future__ import annotations

import argparse

from smsl_studio.cli.arguments import ArgumentParser
from smsl_studio.cli.blueprint_argument import read_argument
from smsl_studio.cli.output import Output, note
from smsl_studio.cli.shape_output import add_output, save_shape
from smsl_studio.front.outputs import form_of
from smsl_studio.front.shapes import LIMIT, identify
from smsl_studio.generate.shapes.identify import FoundCut, Identification
from smsl_studio.legible import one_line
from smsl_studio.stop import look_for_garbage


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``identify``."""
    parser.add_argument("file", metavar="FILE", help="a blueprint; - is standard input")
    add_output(parser, required=False)


def execute(options: argparse.Namespace, out: Output) -> int:
    """List the cuts, the best first, and write the blueprint of the best one if OUT is given."""
    if options.output is not None:
        form_of(options.output)
    blueprint = read_argument(options.file)
    look_for_garbage()
    found = identify(blueprint, options.limit or LIMIT)
    if options.format == "json":
        out.json(found.as_json())
    for one in found.cuts if options.format == "text" else ():
        _print(one, out)
    if found.bound:
        note(f"not all states were tried: the limit is {found.bound}")
    if not found.cuts:
        if options.format == "text":
            out.line("no states could be a sub-SB that saves states or facts")
        return 1
    if options.output is not None:
        save_shape(blueprint, found.cuts[0].after, options.output)
    return 0


def unanswered(reason: str) -> dict[str, object]:
    """Return the JSON for a blueprint in which no groups of states could be searched."""
    return Identification((), reason).as_json()


def _print(one: FoundCut, out: Output) -> None:
    states = f"{one.states_saved} state{'' if one.states_saved == 1 else 's'}"
    facts = f"{one.facts_saved} fact{'' if one.facts_saved == 1 else 's'}"
    out.line(one_line(f"{one.branch.name}: {', '.join(one.cut.chosen.states)}"))
    out.line(one_line(f"    {one.why}"))
    out.line(f"    the base saves {states} and {facts}")
