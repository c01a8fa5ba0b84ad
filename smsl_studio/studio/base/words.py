"""Small functions for words and numbers in panels."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from smsl_studio.blueprint.address import Address
from smsl_studio.errors import StudioError
from smsl_studio.inspection.rules.finding import Finding, Severity
from smsl_studio.legible import plain_text

BLANK = "none"
"""What a screen reader says for an empty cell of a table."""

_LONG = re.compile(r"\S{81,}")
_MOST = 600
"""The length of a sentence (characters) that is not shown whole."""


def counted(number: int, one: str, many: str = "") -> str:
    """A number with its noun: ``1 state``, ``1,000 states``."""
    return f"{number:,} {one if number == 1 else many or one + 's'}"


def series(names: Sequence[str]) -> str:
    """Names in a row: ``a``, ``a and b``, ``a, b and c``."""
    return " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)


def first_lines(lines: Sequence[str], most: int, among: int) -> str:
    """The first ``most`` lines, and how many of ``among`` lines follow."""
    rest = among - most
    return "\n".join([*lines[:most], *([f"and {rest:,} more"] if rest > 0 else [])])


def tally(findings: Iterable[Finding]) -> str:
    """The numbers of findings, such as ``1 error, 2 warnings, 3 notes``, without zeros."""
    found = list(findings)
    parts = (
        (sum(f.severity is severity for f in found), word)
        for severity, word in (
            (Severity.ERROR, "error"),
            (Severity.WARNING, "warning"),
            (Severity.NOTE, "note"),
        )
    )
    return ", ".join(counted(number, word) for number, word in parts if number)


def worst(findings: Iterable[Finding]) -> dict[Address, str]:
    """The highest severity (E or W) at each address.

    Notes are left out, as they have no sign in a drawing.
    """
    found: dict[Address, str] = {}
    for finding in findings:
        if finding.severity is not Severity.NOTE:
            for address in finding.addresses:
                if found.get(address) != "E":
                    found[address] = finding.severity.value
    return found


def subject(finding: Finding) -> str:
    """The element that a message is about, if the message itself does not name it; else empty."""
    name = finding.address.path[-1]
    if finding.address.operation:
        return "" if name in finding.message else name
    return name if finding.message.startswith(("has ", "is ")) else ""


def whole_sentence(finding: Finding) -> str:
    """The message as a sentence that names its element."""
    about = subject(finding)
    return capital(f"{about} {finding.message}" if about else finding.message)


def capital(sentence: str) -> str:
    """The sentence with a capital letter and a full stop.

    A file name at its start stays as it is.
    """
    first = sentence.partition(" ")[0].rstrip(".")
    is_file = "." in first or "/" in first
    said = sentence if is_file else sentence[:1].upper() + sentence[1:]
    return said if said.endswith((".", "?", ":")) or not said else f"{said}."


def refusal_words(error: StudioError) -> str:
    """What is wrong and what to do, as sentences with one full stop each."""
    return " ".join(filter(None, (capital(error.sentence), error.advice)))


def brief(sentence: str) -> str:
    """The sentence with very long names cut, so that the words around them can be read."""
    said = _LONG.sub(lambda name: f"{name[0][:40]}…{name[0][-20:]}", sentence)
    return said if len(said) <= _MOST else f"{said[: _MOST - 1]}…"


def as_it_is(text: str) -> str:
    """A text for a menu or a button, with & escaped, which would underline the next letter."""
    return plain_text(text).replace("&", "&&")
