"""Small pieces of language that several panels use."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from smsl_studio.blueprint.address import Address
from smsl_studio.inspection.rules.finding import Finding, Severity
from smsl_studio.legible import plain_text

BLANK = "none"
"""How a cell of a table is read out that is left blank for the eye."""


def counted(number: int, one: str, many: str = "") -> str:
    """``1 state``, ``10 states``; thousands are set apart."""
    return f"{number:,} {one if number == 1 else many or one + 's'}"


def first_lines(lines: Sequence[str], most: int, among: int) -> str:
    """The first of so many lines, one below the other, and how many more there are."""
    rest = among - most
    return "\n".join([*lines[:most], *([f"and {rest:,} more"] if rest > 0 else [])])


def tally(findings: Iterable[Finding]) -> str:
    """``1 error, 2 warnings, 3 notes``, leaving out what there is none of."""
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
    """The gravest letter (E or W) at every address; a note is no mark on a drawing."""
    found: dict[Address, str] = {}
    for finding in findings:
        if finding.severity is not Severity.NOTE:
            for address in finding.addresses:
                if found.get(address) != "E":
                    found[address] = finding.severity.value
    return found


def subject(finding: Finding) -> str:
    """What a message speaks of that begins with its verb; the empty text for any other message."""
    name = finding.address.path[-1]
    if finding.address.operation:
        return "" if name in finding.message else name
    return name if finding.message.startswith(("has ", "is ")) else ""


def whole_sentence(finding: Finding) -> str:
    """The message as a sentence that names what it is about."""
    about = subject(finding)
    return capital(f"{about} {finding.message}" if about else finding.message)


def capital(sentence: str) -> str:
    """The sentence with a capital letter and a full stop. A file keeps the name it has."""
    first = sentence.partition(" ")[0].rstrip(".")
    is_file = "." in first or "/" in first
    said = sentence if is_file else sentence[:1].upper() + sentence[1:]
    return said if said.endswith((".", "?", ":")) or not said else f"{said}."


def as_it_is(text: str) -> str:
    """A text for a menu or a button, in which & would underline what follows."""
    return plain_text(text).replace("&", "&&")
