"""``route``: prints the cheapest route between two states of one SB. The exit status is 1 if there
is no route."""

from __future__ import annotations

import argparse

from smsl_studio.cli.arguments import ArgumentParser, add_format
from smsl_studio.cli.blueprint_argument import read_argument
from smsl_studio.cli.output import Output, note
from smsl_studio.front.routes import hazards_between, plan_route, unmet_between
from smsl_studio.legible import one_line


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``route``."""
    parser.add_argument("file", metavar="FILE", help="a blueprint; - is standard input")
    parser.add_argument("--from", dest="start", required=True, metavar="S", help="State, SB/State")
    parser.add_argument("--to", dest="goal", required=True, metavar="S", help="State, SB/State")
    parser.add_argument("--sb", metavar="SB", help="the State Branch the states belong to")
    parser.add_argument(
        "--avoid",
        action="append",
        default=[],
        metavar="SB/State/Op",
        help="an operation not to use; may be repeated",
    )
    add_format(parser)


def unanswered(reason: str) -> dict[str, object]:
    """Return the JSON for a route that could not be planned."""
    return {"operations": [], "states": [], "cost": None, "reason": reason}


def execute(options: argparse.Namespace, out: Output) -> int:
    """Print the cheapest route and its cost. 0: there is a route; 1: there is none."""
    blueprint = read_argument(options.file)
    route = plan_route(blueprint, options.start, options.goal, options.avoid, options.sb)
    if route is None:
        named = hazards_between(blueprint, options.start, options.goal, options.avoid, options.sb)
        through = f" but through the hazard {' and '.join(named)}" if named else ""
        note(f"no route leads from {options.start} to {options.goal}{through}")
        asked = (options.start, options.goal, options.avoid, options.sb)
        for words in unmet_between(blueprint, *asked):
            note(words)
        if options.format == "json":
            out.json({"operations": [], "states": [], "cost": None})
        return 1
    if options.format == "json":
        operations = [str(address) for address in route.operations]
        out.json({"operations": operations, "states": list(route.states), "cost": route.cost})
        return 0
    for address, state in zip(route.operations, route.states[1:], strict=True):
        out.line(one_line(f"{address} -> {state}"))
    count = len(route.operations)
    out.line(f"{count} operation{'' if count == 1 else 's'}, cost {route.cost:g}")
    return 0
