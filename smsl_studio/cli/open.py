"""``open``: the window. ``__main__`` opens it before any command; this module has the help."""

from __future__ import annotations

import argparse

from smsl_studio.cli.arguments import ArgumentParser
from smsl_studio.cli.output import Output
from smsl_studio.errors import UsageError


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``open``, for its help."""
    parser.add_argument("files", nargs="*", metavar="FILE", help="blueprints to open")
    modes = ("draw", "run", "supervise", "review")
    parser.add_argument("--mode", choices=modes, default="draw", help="the mode to show")


def execute(options: argparse.Namespace, out: Output) -> int:
    """Raise UsageError, because only ``__main__`` can open the window."""
    raise UsageError(
        "the window is opened by the program itself",
        advice="Start smsl-studio open FILE..., with nothing before it.",
    )
