"""The report of an unexpected error, in words that a person can read before keeping it."""

from __future__ import annotations

import platform
import re
import sys
from datetime import datetime
from pathlib import Path

HEAD = """\
SMSL Studio: report of a failure

This file stays on this machine. Studio sends it nowhere. It has no part of your blueprint but
names that stand in the error itself. Read it before you give it to anybody.
"""
MOST = 20_000
"""The largest number of characters of the trace that a report has; its end counts most."""


LONGEST = 500
"""The largest number of characters of the sentence about the error."""


def report(told: str, when: datetime) -> str:
    """The report: what it is, when it happened, the program and its parts, and the trace.

    The home folder of the user is written as ``~``, because its name may be that of a person.
    """
    trace = told if len(told) <= MOST else f"(shortened)\n{told[-MOST:]}"
    last = told.strip().splitlines()[-1][:LONGEST] if told.strip() else "unknown"
    facts = (
        ("What", last),
        ("When", when.astimezone().isoformat(timespec="seconds")),
        ("Studio", _version("smsl-studio")),
        ("Python", sys.version.split()[0]),
        ("Qt", _version("PySide6")),
        ("System", f"{platform.system()} {platform.release()} {platform.machine()}"),
    )
    lines = "\n".join(f"{name + ':':8}{value}" for name, value in facts)
    return without_home(f"{HEAD}\n{lines}\n\nWhere it happened, the last line first to blame:\n"
                        f"\n{trace.strip()}\n")  # fmt: skip


def without_home(text: str) -> str:
    """The text with ``~`` in the place of the user's home folder."""
    home = str(Path.home())
    return re.sub(re.escape(home) + r"(?=[/\\\s\"':]|$)", "~", text) if len(home) > 1 else text


def file_name(when: datetime) -> str:
    """A name for the file of a report."""
    return f"smsl-studio-failure-{when:%Y-%m-%d-%H%M%S}.txt"


def _version(package: str) -> str:
    from importlib.metadata import PackageNotFoundError, version

    try:
        return version(package)
    except PackageNotFoundError:
        return "unknown"
