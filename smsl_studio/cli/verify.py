"""``verify``: says whether a blueprint is approved. The exit status is 0 only if it is."""

from __future__ import annotations

import argparse

from smsl_studio.cli.arguments import ArgumentParser, add_format, add_world
from smsl_studio.cli.blueprint_argument import read_argument
from smsl_studio.cli.output import Output, note
from smsl_studio.front.verdicts import ApprovalAnswer, ApprovalQuestion, answered, path_of
from smsl_studio.legible import one_line
from smsl_studio.stop import look_for_garbage


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``verify``."""
    parser.add_argument("file", metavar="FILE", help="a blueprint; - is standard input")
    parser.add_argument("--record", metavar="RECORD", help="its record (FILE.record.json)")
    parser.add_argument("--policy", metavar="FILE", help="the trust policy, a TOML file")
    add_world(parser, required=False)
    add_format(parser)


def execute(options: argparse.Namespace, out: Output) -> int:
    """Print the verdict. Return 0 if the blueprint is approved with all conditions met, else 1."""
    blueprint = read_argument(options.file)
    look_for_garbage()
    question = ApprovalQuestion(
        blueprint, path_of(options.record), path_of(options.policy), options.world
    )
    answer = answered(question)
    if options.format == "json":
        out.json({"file": blueprint.file, **answer.judgement.as_json()})
    else:
        _print(blueprint.file, answer, out)
    if answer.trust is not None and not answer.trust.grounds.registered:
        note(answer.trust.keys)
    return 0 if answer.judgement.is_approved else 1


def _print(file: str, answer: ApprovalAnswer, out: Output) -> None:
    judgement = answer.judgement
    for one in judgement.signers:
        said = one.as_json()
        words = f"{said['verdict']} by {said['person']} ({said['role']}), {said['time']}"
        out.line(one_line(f"{file}: {words}, {said['key']}"))
    for refusal in judgement.refusals:
        out.line(f"{one_line(file)}: {out.red(refusal.code)}: {one_line(refusal.sentence)}")
    out.line(one_line(f"{file}: {judgement.verdict}"))
