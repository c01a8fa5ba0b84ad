"""The error for a text that exceeds the limits of a file (see ``limits``)."""

from __future__ import annotations

from smsl_studio.errors import ReadError
from smsl_studio.smsl.document import Document
from smsl_studio.smsl.document.limits import MAX_CHARACTERS, TOO_LONG, too_many_values


def over_budget(text: str) -> tuple[str, str]:
    """Return the sentence and the advice for a text that exceeds a limit."""
    return TOO_LONG if len(text) > MAX_CHARACTERS else too_many_values(text)


def share_of_budget(document: Document) -> int:
    """Return the number of names and values of a document, or slightly more. Only its marks are
    counted.
    """
    marks = {"json": ",{[", "smsl": ("->", "[", "{", "#", ","), "yaml": (":", ",", "- ", "[")}
    return sum(map(document.text.count, marks[document.form]))


def refused_by_budget(document: Document, at: int) -> ReadError:
    """Return the error for a text that exceeds a limit from an offset on."""
    sentence, advice = over_budget(document.text)
    return ReadError(sentence, document.place_at(at), advice)
