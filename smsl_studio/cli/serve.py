"""``serve``: a simulated world for programs elsewhere, until a signal ends it."""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from typing import Any

from smsl_studio.cli.arguments import ArgumentParser, add_format, add_robot, add_world
from smsl_studio.cli.blueprint_argument import read_argument
from smsl_studio.cli.output import Output
from smsl_studio.legible import one_line


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``serve``."""
    add_world(parser, required=True)
    parser.add_argument(
        "--address",
        required=True,
        metavar="ADDRESS",
        help="where to listen: unix:PATH or 127.0.0.1:PORT",
    )
    parser.add_argument(
        "--token-file", metavar="FILE", help="the token that a program must show; a port needs one"
    )
    parser.add_argument(
        "--file", metavar="FILE", help="the blueprint; without it each program sends its own"
    )
    add_robot(parser)
    add_format(parser)


def execute(options: argparse.Namespace, out: Output) -> int:
    """Serve until a signal. There is no other end."""
    from smsl_studio.front.served_worlds import serve

    def tell(event: Mapping[str, Any]) -> None:
        """Print what happens, one line each."""
        if options.format == "json":
            out.json(event)
        else:
            out.line(one_line(_words(event)))

    serve(
        options.world,
        options.address,
        token_file=options.token_file,
        blueprint=None if options.file is None else read_argument(options.file),
        robot=options.robot,
        tell=tell,
    )
    return 0


def _words(event: Mapping[str, Any]) -> str:
    if event["event"] == "serving":
        return f"serving {event['world']} at {event['address']}"
    if event["event"] == "program_came":
        return "a program came"
    braked = "the world is braked" if event["braked"] else "the world did not brake"
    return f"the program left: {event['reason']}; {braked}"
