"""``generate``: a blueprint made of rules, or code made of a blueprint."""

from __future__ import annotations

import argparse

from smsl_studio.cli.arguments import ArgumentParser, add_format
from smsl_studio.cli.blueprint_argument import read_argument
from smsl_studio.cli.output import Output, note
from smsl_studio.errors import UsageError
from smsl_studio.legible import one_line
from smsl_studio.smsl.files import save_document

OF_CODE = ("bindings", "name", "record", "licence", "check")


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``generate``."""
    parser.add_argument("what", choices=("rules", "code"), help="rules: a blueprint; code: of one")
    parser.add_argument("file", metavar="FILE", help="the rules (TOML), or the blueprint")
    parser.add_argument(
        "-o", "--output", required=True, metavar="OUT", help="the blueprint, or the folder of code"
    )
    code = parser.add_argument_group("code")
    code.add_argument("--target", choices=("python",), default="python", help="the language")
    code.add_argument("--bindings", metavar="FILE", help="a bindings file: which function is which")
    code.add_argument("--name", metavar="NAME", help="the name of the package")
    code.add_argument("--record", metavar="RECORD", help="the record whose digest stands in it")
    code.add_argument("--licence", metavar="FILE", help="a text for the top of every file")
    code.add_argument(
        "--check", action="store_true", help="write nothing; say whether code and blueprint agree"
    )
    add_format(parser)


def execute(options: argparse.Namespace, out: Output) -> int:
    """Generate what is asked for. 0: it is written, or agrees; 1: the goal of rules cannot be
    reached, or code and blueprint do not agree.
    """
    if options.what == "code":
        return _code(options, out)
    odd = next((name for name in OF_CODE if getattr(options, name)), None)
    if odd is not None:
        raise UsageError(f"--{odd} is for code alone", advice="Write: generate code FILE -o DIR.")
    return _rules(options, out)


def _rules(options: argparse.Namespace, out: Output) -> int:
    from smsl_studio.front.generated import generate_rules
    from smsl_studio.front.outputs import converted

    made = generate_rules(options.file)
    document = converted(made.blueprint, options.output).document
    save_document(document, options.output, made_of=[options.file])
    if options.format == "json":
        out.json({"states": made.states, "operations": made.operations, "goal": made.goal_reached})
    else:
        words = f"{options.output}: {made.states:,} states, {made.operations:,} operations"
        out.line(one_line(words))
    if not made.goal_reached:
        note("the goal cannot be reached with these rules; ACTIVATING is left out")
    return 0 if made.goal_reached else 1


def _code(options: argparse.Namespace, out: Output) -> int:
    from smsl_studio.front.generated_code import generate_code

    made = generate_code(
        read_argument(options.file),
        options.output,
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
