"""``approve``: signs the result of the check, and a person's decision about it."""

from __future__ import annotations

import argparse
from pathlib import Path

from smsl_studio.cli.arguments import ArgumentParser, add_format, add_limit
from smsl_studio.cli.blueprint_argument import STDIN, read_argument
from smsl_studio.cli.output import Output, note
from smsl_studio.cli.passphrase import add_passphrase, passphrase
from smsl_studio.errors import ApprovalRefused, UsageError
from smsl_studio.front.inputs import inspect
from smsl_studio.front.signatures import VERDICTS, ApprovalRequest, approve
from smsl_studio.inspection.approval.statement import InspectionOptions
from smsl_studio.legible import one_line
from smsl_studio.stop import look_for_garbage


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``approve``."""
    parser.add_argument("file", metavar="FILE", help="a blueprint")
    parser.add_argument("--key", required=True, metavar="ID", help="the key that signs")
    parser.add_argument("--verdict", choices=VERDICTS, help="what you say (default: approved)")
    _several(parser, "--condition", "TEXT", "a condition that must be met before a run")
    _several(parser, "--met", "TEXT", "the exact text of a condition that is met")
    _several(parser, "--disposition", "RULE@ADDRESS=TEXT", "what you say about a warning")
    parser.add_argument("--expires", metavar="DATE", help="the last day, such as 2027-01-31")
    _several(parser, "--world", "NAME", "sign the code of this world too")
    _several(parser, "--relies-on", "FILE", "an imported file that you did not look at again")
    parser.add_argument(
        "-o", "--output", metavar="RECORD", help="the record (default: FILE.record.json)"
    )
    parser.add_argument(
        "--rule", action="append", metavar="R", help="ask only this rule; may be repeated"
    )
    add_limit(parser, "store at most N configurations to show properties (default 1,000,000)")
    parser.add_argument(
        "--with-failures", action="store_true", help="properties begin also where one SB has failed"
    )
    parser.add_argument(
        "--recoverability", action="store_true", help="every failure state must have a way back"
    )
    add_passphrase(parser)
    add_format(parser)


def execute(options: argparse.Namespace, out: Output) -> int:
    """Sign the record. Return 0 if it is signed, and 1 if something is open."""
    blueprint = read_argument(options.file)
    if blueprint.file == STDIN:
        raise UsageError("standard input cannot be approved", advice="Name a file.")
    inspect(blueprint, options.rule if options.rule else ())
    look_for_garbage()
    request = ApprovalRequest(
        blueprint,
        options.key,
        b"",
        verdict=options.verdict or "",
        conditions=tuple(options.condition),
        met=tuple(options.met),
        dispositions=tuple(options.disposition),
        expires=options.expires,
        worlds=tuple(dict.fromkeys(options.world)),
        relies_on=tuple(options.relies_on),
        record=Path(options.output) if options.output else None,
        options=InspectionOptions(
            limit=options.limit,
            with_failures=options.with_failures,
            recoverability=options.recoverability,
            rules=options.rule,
        ),
    ).checked()
    try:
        done = approve(request.opened_with(passphrase(options, options.key)))
    except ApprovalRefused as refused:
        for line in refused.sentence.split("\n"):
            note(f"{options.file}: {line}")
        note(refused.advice or "Nothing was signed.")
        if options.format == "json":
            out.json({"file": blueprint.file, "record": None, "reason": refused.sentence})
        return 1
    said = done.record.statement.predicate
    if options.format == "json":
        out.json(
            {
                "file": blueprint.file,
                "record": str(done.file),
                "verdict": said.verdict,
                "person": said.person,
                "role": said.role,
                "key": done.record.envelope.keyid,
                "time": said.time,
                "digest": f"sha256:{done.record.digest}",
            }
        )
    else:
        words = f"{blueprint.file}: {said.verdict} by {said.person} ({said.role}), in {done.file}"
        out.line(one_line(words))
    return 0


def _several(parser: ArgumentParser, name: str, metavar: str, words: str) -> None:
    parser.add_argument(
        name, action="append", default=[], metavar=metavar, help=f"{words}; may be repeated"
    )
