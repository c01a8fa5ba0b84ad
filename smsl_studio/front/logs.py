"""Reads the log of a run: its events, its integrity, and an account of it."""

from __future__ import annotations

import os
import re
from dataclasses import replace
from io import BytesIO
from pathlib import Path
from typing import BinaryIO

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.errors import Place, SealError, UsageError
from smsl_studio.runlog.grammar.log_reader import (
    IMPOSSIBLE,
    Doubt,
    LoggedRun,
    LogVerdict,
    open_log,
    read_records,
)
from smsl_studio.runlog.grammar.log_reader import verify as verify_log
from smsl_studio.smsl.files import save_document

Name = str | os.PathLike[str]


def replay(log: Name) -> LoggedRun:
    """Read a logged run: its header and its events, in order.

    ReadError if a line is no event of a run. A log that was cut or changed is read as far as
    possible. ``doubt`` then names the first wrong line; it is None for a sound log.

    >>> told = replay("run.jsonl")
    >>> told.events[-1].reason, told.doubt
    ('goal_reached', None)
    """
    with open_log(Path(log)) as stream:
        return read_records(stream, os.fspath(log), COMMANDS)


def verify(log: Name, blueprint: Blueprint | None = None) -> LogVerdict:
    """Check that a log is complete and unchanged, and that its events are possible in a run.

    ``blueprint`` is the blueprint that was run. If it is given, the run is computed again from it,
    as ``verify.py`` in a bundle does. ``doubt`` is None for a good log. Else it is the first wrong
    line, with its place and a sentence.

    >>> verify("run.jsonl").doubt is None
    True
    """
    with open_log(Path(log)) as stream:
        return verify_stream(stream, os.fspath(log), blueprint)


def verify_stream(stream: BinaryIO, file: str, blueprint: Blueprint | None = None) -> LogVerdict:
    """Check the log in a stream, as ``verify`` does. Messages call it by ``file``."""
    if blueprint is None:
        return _with_signer(verify_log(stream, file, COMMANDS), file)
    from smsl_studio.front.verifier import told_again

    raw = stream.read()
    verdict = verify_log(BytesIO(raw), file, COMMANDS)
    why = told_again(raw, blueprint)
    if not why and verdict.doubt is not None and verdict.doubt.sentence.startswith(IMPOSSIBLE):
        verdict = replace(verdict, doubt=None, order=verdict.doubt)
    if not why:
        return _with_signer(verdict, file)
    line = _LINE.match(why)
    place = Place(file, int(line[1]) if line else 1, 1)
    return replace(verdict, doubt=Doubt(place, why[line.end() :] if line else why))


def _with_signer(verdict: LogVerdict, file: str) -> LogVerdict:
    """Return the verdict with the signer of the head, or with the doubt that nobody here signed
    it."""
    head = verdict.head
    if head is None or not head.signed or verdict.doubt is not None:
        return verdict
    from smsl_studio.inspection.approval.log_seal import signer_of

    try:
        key = signer_of(head.raw, head.signed)
    except SealError as error:
        place = Place(file, verdict.events + 2, 1)
        return replace(verdict, doubt=Doubt(place, error.sentence))
    return replace(verdict, signer=f"{key.person} ({key.id})")


_LINE = re.compile(r"line (\d+): ", re.ASCII)


def account(log: Name, output: Name) -> LoggedRun:
    """Write an account of a logged run in sentences, as an ``.html`` page. Return the run.

    UsageError if ``output`` is no name of a page. ReadError if the log cannot be read. SaveError if
    the page cannot be written.

    >>> account("run.jsonl", "account.html").doubt is None
    True
    """
    from smsl_studio.picture.account import account as page_of

    check_page(output)
    run = replay(log)
    save_document(page_of(run, COMMANDS), output, made_of=[os.fspath(log)])
    return run


def check_page(output: Name) -> None:
    """Raise UsageError if ``output`` is no name of an HTML page."""
    if Path(output).suffix.lower() not in (".html", ".htm"):
        raise UsageError(
            f"{os.fspath(output)!r} is no name of a page", advice="Let it end in .html."
        )
