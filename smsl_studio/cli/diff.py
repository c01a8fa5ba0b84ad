"""``diff``: compares the meaning of two files, or what they do. The exit status is 1 if they
differ.

git can call it as an external diff driver, with seven arguments (nine for a renamed file, one for
an unmerged file). Then it must always end with 0.
"""

from __future__ import annotations

import argparse
import os

from smsl_studio.blueprint.comparison import Change, Difference
from smsl_studio.blueprint.comparison.signs import ADDED, REMOVED, sign_of
from smsl_studio.cli.arguments import ArgumentParser, add_format, add_limit, add_picture
from smsl_studio.cli.blueprint_argument import inputs_of, read_argument
from smsl_studio.cli.git_driver import by_git, show_for_git
from smsl_studio.cli.output import Output
from smsl_studio.errors import UsageError
from smsl_studio.front.outputs import diff, drawn_difference, picture_form
from smsl_studio.legible import one_line
from smsl_studio.smsl.files import save_document
from smsl_studio.stop import look_for_garbage


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``diff``."""
    parser.add_argument(
        "files", nargs="+", metavar="FILE", help="the earlier and the later blueprint; - is one"
    )
    parser.add_argument(
        "--behaviour",
        action="store_true",
        help="compare what they do from their starts, not how they are written",
    )
    add_limit(parser, "with --behaviour: store at most N configurations (default 1,000,000)")
    add_picture(parser, required=False)
    parser.add_argument(
        "--collapse",
        action="store_true",
        help="with -o: draw unchanged operations between the same two states as one line",
    )
    add_format(parser)


def execute(options: argparse.Namespace, out: Output) -> int:
    """Print the differences, and draw them if ``-o`` is given. 0: equal meaning; 1: it differs."""
    files: list[str] = options.files
    if by_git(files, os.environ):
        show_for_git(files, out, print_difference)
        return 0
    if len(files) != 2:
        raise UsageError(
            f"two files are compared, and {len(files)} are named",
            advice="smsl-studio diff BEFORE AFTER",
        )
    if files == ["-", "-"]:
        raise UsageError("standard input cannot be both files", advice="Name one of them.")
    if options.collapse and not options.output:
        raise UsageError("--collapse is about a picture", advice="Name it with -o.")
    if options.behaviour:
        return _compare_behaviour(options, out)
    if options.output:
        picture_form(options.output)
    difference = diff(read_argument(files[0]), read_argument(files[1]))
    if options.output:
        _draw(difference, options.output, options.collapse)
    if options.format == "json":
        out.json(difference.as_json())
    else:
        print_difference(difference, out)
    return 1 if difference.changes else 0


def unanswered(reason: str) -> dict[str, object]:
    """Return the JSON for a comparison of behaviours that gave no answer."""
    return {"equal": None, "path": [], "reason": reason, "configurations": [0, 0]}


def _compare_behaviour(options: argparse.Namespace, out: Output) -> int:
    """Print whether two blueprints behave alike. 0: they do; 1: they do not, or it is unknown."""
    from smsl_studio.front.shapes import LIMIT, diff_behaviour

    if options.output:
        raise UsageError("--behaviour draws no picture", advice="Leave out -o.")
    before, after = map(read_argument, options.files)
    look_for_garbage()
    found = diff_behaviour(before, after, options.limit or LIMIT)
    if options.format == "json":
        out.json(found.as_json())
        return 0 if found.equal else 1
    counts = " and ".join(f"{count:,}" for count in found.configurations)
    verdict = {True: "Same behaviour", False: "They differ", None: "Unknown"}[found.equal]
    out.line(one_line(": ".join(filter(None, (verdict, found.reason)))))
    if found.path:
        out.line(one_line(f"Run: {', '.join(found.path)}"))
    out.line(f"Looked at {counts} configurations.")
    return 0 if found.equal else 1


def print_difference(difference: Difference, out: Output) -> None:
    """Print one line for each change: sign, address, sentence, places. The sum comes last.

    Differences without a meaning follow below a line of their own.
    """
    for change in difference.changes:
        sign = sign_of(change.kind)
        paint = {ADDED: out.green, REMOVED: out.red}.get(sign, out.yellow)
        out.line(paint(_told(sign, change)) + _places(difference, change))
    if difference.fields:
        out.line("Beside the meaning:")
    for change in difference.fields:
        sign = sign_of(change.kind)
        out.line(f"  {_told(sign, change)}{_places(difference, change)}")
    out.line(one_line(difference.words))


def _told(sign: str, change: Change) -> str:
    where = "" if change.address is None else f"{change.address}: "
    return one_line(f"{sign} {where}{change.words}")


def _draw(difference: Difference, output: str, collapsed: bool) -> None:
    inputs = (*inputs_of(difference.before), *inputs_of(difference.after))
    picture = drawn_difference(difference, output, collapsed)
    save_document(picture, output, made_of=inputs)


def _places(difference: Difference, change: Change) -> str:
    places = difference.place_before(change), difference.place_after(change)
    told = " -> ".join(str(place) for place in places if place is not None)
    return one_line(f" ({told})") if told else ""
