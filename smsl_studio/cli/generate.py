"""``generate``: a blueprint made of rules, of a planning problem, of physics or of text, code made
of a blueprint, or a driver."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from smsl_studio.cli.arguments import ArgumentParser, add_format
from smsl_studio.cli.blueprint_argument import inputs_of, read_argument
from smsl_studio.cli.generate_text import OPTIONS as TEXT_OPTIONS
from smsl_studio.cli.generate_text import add_text_arguments, generate_of_text
from smsl_studio.cli.output import Output, note
from smsl_studio.errors import UsageError
from smsl_studio.legible import one_line
from smsl_studio.smsl.files import save_document

if TYPE_CHECKING:
    from smsl_studio.blueprint.model import Blueprint
    from smsl_studio.front.generated import Generated
    from smsl_studio.front.physics import PhysicsDifference

_FILES = {"rules": ("RULES.toml",), "pddl": ("DOMAIN", "PROBLEM"), "explore": (), "code": ("FILE",),
          "text": ("FILE...",), "driver": ()}  # fmt: skip
"""What stands behind each word."""
_OPTIONS = {
    "rules": ("limit",),
    "explore": ("world", "robot", "start", "repeats", "rates", "limit", "against"),
    "code": ("bindings", "name", "record", "licence", "check"),
    "text": TEXT_OPTIONS,
}
"""The options that belong to some words alone."""


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``generate``."""
    parser.add_argument("what", choices=tuple(_FILES), help="what it is made of")
    parser.add_argument(
        "files",
        nargs="*",
        metavar="FILE",
        help="rules: RULES.toml; pddl: DOMAIN PROBLEM; code: FILE; text: FILE...; driver: none",
    )
    parser.add_argument(
        "-o",
        "--output",
        required=True,
        metavar="OUT",
        help="a blueprint, or the folder of a program",
    )
    explore = parser.add_argument_group("explore")
    explore.add_argument("--world", metavar="W", help="the world that is explored")
    explore.add_argument("--robot", metavar="NAME", help="the robot, where a world has several")
    explore.add_argument(
        "--start",
        metavar="FILE|VALUES",
        help="a blueprint with the start, the facts and their values; or values: a,a,a",
    )
    explore.add_argument(
        "--repeats", type=_count, metavar="N", help="how often each operation must succeed (1)"
    )
    explore.add_argument(
        "--rates",
        action="store_true",
        help="keep what works in some of the repeats, with its cost and risk, and failure states",
    )
    explore.add_argument(
        "--limit",
        type=_count,
        metavar="N",
        help="so many states at most (default 10,000; rules: 1,000,000)",
    )
    explore.add_argument("--against", metavar="FILE", help="compare the edges with a blueprint")
    code = parser.add_argument_group("code")
    code.add_argument("--target", choices=("python", "cpp", "ros2"), default="python", help="what")
    code.add_argument("--bindings", metavar="FILE", help="a bindings file: which function is which")
    code.add_argument("--name", metavar="NAME", help="the name of the package")
    code.add_argument("--record", metavar="RECORD", help="the record whose digest stands in it")
    code.add_argument("--licence", metavar="FILE", help="a text for the top of every file")
    code.add_argument(
        "--check", action="store_true", help="write nothing; say whether code and blueprint agree"
    )
    add_text_arguments(parser)
    add_format(parser)


def execute(options: argparse.Namespace, out: Output) -> int:
    """Generate what is asked for. 0: it is written, or agrees; 1: the goal cannot be reached,
    physics permits something else (``--against``), or code and blueprint do not agree."""
    wanted = _FILES[options.what]
    many = len(options.files)
    if many != len(wanted) and not (options.what == "text" and many):
        takes = " ".join(wanted) or "no file but --start"
        if options.what == "driver":
            raise UsageError(
                "generate driver takes no file", advice="Write generate driver -o DIR."
            )
        advice = f"Write smsl-studio generate {options.what} {' '.join(wanted)} -o OUT.json."
        raise UsageError(f"generate {options.what} takes {takes}", advice=advice)
    own = _OPTIONS.get(options.what, ())
    for what, names in _OPTIONS.items():
        odd = next((name for name in names if getattr(options, name) and name not in own), None)
        if odd is not None:
            raise UsageError(
                f"--{odd.replace('_', '-')} is for {what} alone",
                advice=f"Write: generate {what} ...",
            )
    if options.what == "explore":
        return _explore(options, out)
    if options.what == "text":
        return generate_of_text(options, out)
    if options.what == "code":
        return _code(options, out)
    if options.what == "driver":
        return _driver(options, out)
    from smsl_studio.front.generated import generate_pddl, generate_rules
    from smsl_studio.generate.rule_states import MOST_STATES

    if options.what == "rules":
        made = generate_rules(options.files[0], options.limit or MOST_STATES)
    else:
        made = generate_pddl(*options.files)
    _save(options, made, options.files)
    _tell(options, out, made)
    if not made.whole:
        note(f"the rules reach more than these {made.states:,} states; what leads to others is "
             "left out. Leave states out with 'never', or take fewer facts.")  # fmt: skip
    if not made.goal_reached:
        of = "with these rules" if options.what == "rules" else "in this problem"
        note(f"the goal cannot be reached {of}; ACTIVATING is left out" if made.whole
             else "the goal is none of these states; ACTIVATING is left out")  # fmt: skip
    return 0 if made.goal_reached and made.whole else 1


def _explore(options: argparse.Namespace, out: Output) -> int:
    from smsl_studio.front.physics import LIMIT, against, generate_explore

    if options.world is None or options.start is None:
        raise UsageError("generate explore takes --world and --start")
    start = _start(options.start, options.world)
    other = None if options.against is None else read_argument(options.against)
    limit = options.limit or LIMIT
    repeats, robot = options.repeats or 1, options.robot or ""
    if options.rates and repeats < 2:
        raise UsageError(
            "--rates needs several attempts with each operation", advice="Add --repeats 10."
        )
    part = Path(f"{options.output}.part")
    found = generate_explore(
        start,
        options.world,
        repeats=repeats,
        limit=limit,
        robot=robot,
        part=part,
        rates=options.rates,
    )
    made = found.generated
    _save(options, made, [*inputs_of(start), *(inputs_of(other) if other else ())])
    part.unlink(missing_ok=True)
    if found.bound:
        note(f"there are more than {limit:,} states; what leads to them is left out")
    for address, worked in found.rates.items():
        note(one_line(f"{address}: worked in {worked} of {repeats}"))
    if other is not None:
        return _compared(options, out, against(made.blueprint, other, found.idle))
    _tell(options, out, made)
    if not made.goal_reached:
        note("the ACTIVATING state of the start was not reached; ACTIVATING is left out")
    return 0 if made.goal_reached and not found.bound else 1


def _start(text: str, world: str) -> Blueprint:
    """Return the start: the blueprint in a file, or some values."""
    from smsl_studio.front.physics import start_of_values

    if text == "-" or any(sign in text for sign in "./\\"):
        return read_argument(text)
    return start_of_values(text, world)


def _code(options: argparse.Namespace, out: Output) -> int:
    from smsl_studio.front.generated_code import generate_code

    made = generate_code(
        read_argument(options.files[0]),
        options.output,
        target=options.target,
        name=options.name or "",
        bindings=options.bindings,
        record=options.record,
        licence=options.licence,
        check=options.check,
    )
    if options.format == "json":
        changed, gone, kept = list(made.changed), list(made.gone), list(made.kept)
        count = len(made.files)
        out.json({"files": count, "changed": changed, "gone": gone, "kept": kept})
    elif not options.check:
        words = f"{len(made.files)} files, {len(made.changed)} written, {len(made.kept)} parts kept"
        out.line(one_line(f"{options.output}: {words}"))
    else:
        for path in (*made.changed, *made.gone):
            out.line(one_line(f"{options.output}/{path}: is not what the blueprint gives"))
    return 0 if made.agrees or not options.check else 1


def _driver(options: argparse.Namespace, out: Output) -> int:
    from smsl_studio.front.generated_code import generate_driver

    made = generate_driver(options.output, target=options.target)
    if options.format == "json":
        out.json({"files": list(made.files), "changed": list(made.changed)})
    else:
        for name in made.files:
            out.line(one_line(f"{options.output}/{name}"))
    return 0


def _compared(options: argparse.Namespace, out: Output, difference: PhysicsDifference) -> int:
    if options.format == "json":
        out.json({"edges": difference.edges, "missing": list(difference.missing),
                  "false": list(difference.false)})  # fmt: skip
    else:
        out.line(f"{difference.edges:,} edges")
        for address in difference.missing:
            out.line(one_line(f"missing: {address}"))
        for address in difference.false:
            out.line(one_line(f"false: {address}"))
    return 1 if difference.missing or difference.false else 0


def _save(options: argparse.Namespace, made: Generated, inputs: Sequence[str | int]) -> None:
    from smsl_studio.front.outputs import converted

    document = converted(made.blueprint, options.output).document
    save_document(document, options.output, made_of=inputs)


def _tell(options: argparse.Namespace, out: Output, made: Generated) -> None:
    if options.format == "json":
        out.json({"states": made.states, "operations": made.operations, "goal": made.goal_reached})
    else:
        words = f"{options.output}: {made.states:,} states, {made.operations:,} operations"
        out.line(one_line(words))


def _count(text: str) -> int:
    number = int(text) if text.isascii() and text.isdecimal() and len(text) < 10 else 0
    if number < 1:
        raise argparse.ArgumentTypeError(f"{text!r} is no whole number from 1")
    return number
