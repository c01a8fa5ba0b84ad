"""One document in another written form: the same values, and its comments where it can hold any."""

from __future__ import annotations

from dataclasses import dataclass, replace

from smsl_studio.errors import ConvertError
from smsl_studio.smsl.document import WORDS, Document
from smsl_studio.smsl.forms import HOLD_COMMENTS, form_named


@dataclass(frozen=True)
class Converted:
    """The document in its new form, and how many comments the form has no room for."""

    document: Document
    comments_left: int = 0


def convert(document: Document, form: str, file: str) -> Converted:
    """A document under another name and in another form; in its own form, to the byte the same.

    ConvertError, with a sentence that says why, where something in it has no spelling there.
    """
    if form == document.form:
        return Converted(replace(document, file=file))
    _must_be_single(document, form)
    said = form_named(document.form).comments_in(document)
    doors = form_named(form)
    written = doors.parse(doors.write(document.values, said), file)
    return Converted(written, 0 if form in HOLD_COMMENTS else len(said))


def _must_be_single(document: Document, form: str) -> None:
    """Refuse what is written twice: only the winner would be written, and the rest be lost."""
    for path, places in document.duplicates():
        raise ConvertError(
            f"{'/'.join(path)} is written {len(places)} times, and {WORDS[form]} would keep the "
            "last alone",
            places[-1],
            "Keep one of them first (the quick fix of R01 keeps the last).",
        )
