"""``explore``: prints the configurations of all SBs together. The exit status is 1 if the coupled
SBs have a disagreement or a trap, or if the limit was met."""

from __future__ import annotations

import argparse

from smsl_studio.cli.arguments import ArgumentParser, add_effort, add_format, add_limit
from smsl_studio.cli.blueprint_argument import read_argument
from smsl_studio.cli.output import Output
from smsl_studio.front.exploration import LIMIT, ExploredSpace, explore
from smsl_studio.inspection.explorer.explorer import ExploredMode, FoundPlace
from smsl_studio.legible import one_line
from smsl_studio.stop import look_for_garbage


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``explore``."""
    parser.add_argument("file", metavar="FILE", help="a blueprint; - is standard input")
    add_limit(parser, "store at most N configurations (default 1,000,000)")
    add_effort(parser)
    add_format(parser)


def execute(options: argparse.Namespace, out: Output) -> int:
    """Print what can happen in both modes. 0: the coupled SBs agree and have no trap; 1: not."""
    blueprint = read_argument(options.file)
    look_for_garbage()
    found = explore(blueprint, options.limit or LIMIT, options.seconds, options.memory)
    if options.format == "json":
        out.json(found.as_json())
    else:
        _print("ours", found.ours, out)
        _print("free", found.free, out)
    return 0 if found.ours.clean else 1


def unanswered(reason: str) -> dict[str, object]:
    """Return the JSON for a blueprint that cannot be explored. No configuration was reached."""
    nothing = ExploredMode(0, (), 0, (), 0, reason)
    return ExploredSpace((), nothing, nothing).as_json()


def _print(name: str, mode: ExploredMode, out: Output) -> None:
    more = "at least " if mode.bound else ""
    traps = "traps not known" if mode.bound else _counted(mode.trap_count, "trap")
    disagreements = _counted(mode.disagreement_count, "disagreement")
    out.line(f"{name}: {more}{mode.configurations:,} configurations, {disagreements}, {traps}")
    if mode.bound:
        out.line(f"  met the limit of {mode.bound}")
    for words, places in (("disagreement", mode.disagreements), ("trap", mode.traps)):
        for place in places[:_SHOWN]:
            out.line(one_line(f"  {words}: {_told(place)}"))


def _told(place: FoundPlace) -> str:
    states = ", ".join(f"{name} in {state}" for name, state in place.configuration.items())
    path = ", ".join(str(one) for one in place.path[:_SHOWN])
    more = " and so on" if len(place.path) > _SHOWN else ""
    return f"{states}, by {path}{more}" if path else f"{states}, at the start"


def _counted(count: int, noun: str) -> str:
    return f"{count:,} {noun}{'' if count == 1 else 's'}"


_SHOWN = 5
