"""``git-setup``: lets git compare and merge the blueprints of a repository by what they mean."""

from __future__ import annotations

import argparse

from smsl_studio.cli.arguments import ArgumentParser
from smsl_studio.cli.output import Output
from smsl_studio.front.git_drivers import git_setup
from smsl_studio.legible import one_line


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``git-setup``."""
    parser.add_argument(
        "folder", nargs="?", default=".", metavar="FOLDER", help="a folder of the repository"
    )
    parser.add_argument("--undo", action="store_true", help="take back what it wrote")


def execute(options: argparse.Namespace, out: Output) -> int:
    """Write or take back the attributes and commands, and say which. 0: done."""
    done = git_setup(options.folder, options.undo)
    verb = "taken back from" if options.undo else "written into"
    if done.changed:
        out.line(one_line(f"{verb} {done.attributes}: the block of smsl-studio"))
    for key in done.keys:
        out.line(one_line(f"{verb} the configuration of this checkout: {key}"))
    if not (done.changed or done.keys):
        out.line("nothing to take back" if options.undo else "all is written already")
    return 0
