"""The log of a run, read again: what it tells, whether it is the one that was written."""

from __future__ import annotations

import os
from pathlib import Path

from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.errors import UsageError
from smsl_studio.runlog.grammar.log_reader import (
    LoggedRun,
    LogVerdict,
    open_log,
    read_records,
)
from smsl_studio.runlog.grammar.log_reader import verify as verify_stream
from smsl_studio.smsl.files import save_document

Name = str | os.PathLike[str]


def replay(log: Name) -> LoggedRun:
    """A logged run: its header, its events in order, and in ``doubt`` what is wrong with it.

    ReadError where a line is no event of a run. A log that was cut short or changed is read as far
    as it goes, and ``doubt`` names the line.

    >>> told = replay("run.jsonl")
    >>> told.events[-1].reason, told.doubt
    ('goal_reached', None)
    """
    with open_log(Path(log)) as stream:
        return read_records(stream, os.fspath(log), COMMANDS)


def verify(log: Name) -> LogVerdict:
    """Whether a log is whole and unchanged, and tells a story that a run can tell.

    ``doubt`` is None where it is; else the first line that is wrong, with place and sentence.

    >>> verify("run.jsonl").doubt is None
    True
    """
    with open_log(Path(log)) as stream:
        return verify_stream(stream, os.fspath(log), COMMANDS)


def account(log: Name, output: Name) -> LoggedRun:
    """Write a page (``.html``) that tells a logged run in sentences; the run that was read.

    UsageError where ``output`` is no name of a page, ReadError, SaveError.

    >>> account("run.jsonl", "account.html").doubt is None
    True
    """
    from smsl_studio.picture.account import account as page_of

    check_page(output)
    run = replay(log)
    save_document(page_of(run, COMMANDS), output, made_of=[os.fspath(log)])
    return run


def check_page(output: Name) -> None:
    """UsageError where this is no name of a page."""
    if Path(output).suffix.lower() not in (".html", ".htm"):
        raise UsageError(
            f"{os.fspath(output)!r} is no name of a page", advice="Let it end in .html."
        )
