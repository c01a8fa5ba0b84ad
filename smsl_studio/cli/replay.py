"""``replay``: prints the events of a run from its log, verifies the log, or writes an account."""

from __future__ import annotations

import argparse
import contextlib
import io
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.cli.arguments import ArgumentParser, add_format
from smsl_studio.cli.blueprint_argument import STDIN, read_argument
from smsl_studio.cli.output import Output, note
from smsl_studio.cli.story import line_of
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.errors import Place, ReadError, UsageError
from smsl_studio.front.log_seals import has_recorder
from smsl_studio.front.logs import check_page, verify_stream
from smsl_studio.legible import json_text, one_line
from smsl_studio.runlog.grammar.log_reader import (
    LogReader,
    LogVerdict,
    open_log,
    read_records,
)
from smsl_studio.runlog.log import FORMER
from smsl_studio.smsl.files import save_document

BEFORE = (
    f"a log of version {FORMER}: its goals were told without a fresh check, "
    "and it does not say what its states want of their facts"
)
UNSIGNED = (
    "its head is not signed, and this computer has a recorder's key: another may have written it"
)
WITHOUT = "the story was not told again, because no --blueprint FILE is named"


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``replay``."""
    parser.add_argument("log", metavar="LOG", help="a log of run --log; - is standard input")
    instead = parser.add_mutually_exclusive_group()
    instead.add_argument(
        "--verify",
        action="store_true",
        help="check the chain over the raw bytes, and the head, instead of telling the events",
    )
    parser.add_argument(
        "--blueprint",
        metavar="FILE",
        help="with --verify: the blueprint that was run; the story is told again from it",
    )
    instead.add_argument(
        "-o", "--output", metavar="OUT.html", help="write an account of the run instead"
    )
    add_format(parser)


def execute(options: argparse.Namespace, out: Output) -> int:
    """Print the events of a log, verify it, or write its account. 1: the log is not sound."""
    if options.output is not None:
        check_page(options.output)
    blueprint = None
    if options.blueprint is not None:
        if not options.verify:
            raise UsageError("--blueprint is for --verify alone", advice="Add --verify.")
        if options.blueprint == "-" == options.log:
            raise UsageError("log and blueprint cannot both be standard input")
        blueprint = read_argument(options.blueprint)
    with _log(options.log) as (stream, file):
        if options.verify:
            return _verify(stream, file, blueprint, options.format, out)
        if options.output is not None:
            return _account(stream, file, options.output, options.format, out)
        return _tell(stream, file, options.format, out)


def _tell(stream: BinaryIO, file: str, form: str, out: Output) -> int:
    reader = LogReader(stream, file, COMMANDS)
    for record in reader.records():
        out.line(json_text(record.text) if form == "json" else one_line(line_of(record.event)))
    if reader.doubt is not None:
        note(str(reader.doubt))
    return 0


def _verify(
    stream: BinaryIO, file: str, blueprint: Blueprint | None, form: str, out: Output
) -> int:
    verdict = verify_stream(stream, file, blueprint)
    if form == "json":
        told_from = {} if blueprint is None else {"blueprint": blueprint.file}
        out.json({**_as_json(verdict, file), **told_from})
    elif verdict.doubt is not None:
        out.line(one_line(str(verdict.doubt)))
    else:
        assert verdict.head is not None
        many = f"{verdict.events} event{'' if verdict.events == 1 else 's'}"
        former = f" ({BEFORE})" if verdict.version == FORMER else ""
        signed = f", signed by {verdict.signer}" if verdict.signer else ""
        told = f", told again from {blueprint.file}" if blueprint is not None else ""
        out.line(one_line(f"{file}: verified: {many}, {verdict.head.hash}{former}{signed}{told}"))
    if verdict.order is not None:
        odd = verdict.order
        note(f"{odd.place}: the blueprint permits this, and it is odd: {odd.sentence}")
    if verdict.doubt is None and not verdict.signer and has_recorder():
        note(UNSIGNED)
    if blueprint is None and verdict.doubt is None:
        note(WITHOUT)
    return 0 if verdict.doubt is None else 1


def _as_json(verdict: LogVerdict, file: str) -> dict[str, object]:
    doubt, head = verdict.doubt, verdict.head
    return {
        "file": file,
        "verified": doubt is None,
        "events": verdict.events,
        "version": verdict.version,
        "head": {"count": head.count, "hash": head.hash} if head else None,
        "line": doubt.place.line if doubt else None,
        "column": doubt.place.column if doubt else None,
        "message": doubt.sentence if doubt else "",
        **({"signed": verdict.signer} if verdict.signer else {}),
    }


def _account(stream: BinaryIO, file: str, output: str, form: str, out: Output) -> int:
    from smsl_studio.picture.account import account

    run = read_records(stream, file, COMMANDS)
    save_document(account(run, COMMANDS), output, made_of=[0 if file == STDIN else file])
    if form == "json":
        verdict = LogVerdict(len(run.records), run.head, run.doubt, int(run.header["version"]))
        out.json(_as_json(verdict, file) | {"output": output})
    if run.doubt is not None:
        note(str(run.doubt))
    return 0


@contextlib.contextmanager
def _log(file: str) -> Iterator[tuple[BinaryIO, str]]:
    """Open a log. Yield its bytes and its name for messages."""
    if file == "-":
        yield _standard_input(), STDIN
        return
    with open_log(Path(file)) as stream:
        yield stream, file


def _standard_input() -> BinaryIO:
    if sys.stdin is None:
        raise ReadError(
            "standard input cannot be read: it is closed",
            Place(STDIN, 1, 1),
            "Name a file instead of -.",
        )
    return getattr(sys.stdin, "buffer", None) or io.BytesIO(sys.stdin.read().encode())
