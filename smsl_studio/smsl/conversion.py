"""Converts a document to another written form: the same values, with its comments if the form has
any.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from smsl_studio.errors import ConvertError
from smsl_studio.smsl.document import WORDS, Document
from smsl_studio.smsl.forms import HOLD_COMMENTS, form_named


@dataclass(frozen=True)
class Converted:
    """The document in its new form, and the number of comments that are lost."""

    document: Document
    comments_left: int = 0


def convert(document: Document, form: str, file: str) -> Converted:
    """Return a document under another name and in another form. In its own form the text stays the
    same.

    ConvertError, with the reason, if the other form cannot express a part of it.
    """
    if form != document.form:
        _must_be_single(document, form)
    return converted(document, form, file)


def converted(document: Document, form: str, file: str) -> Converted:
    """Convert like ``convert``. Of a key that is written twice, only the last value is written,
    because that value counts.
    """
    if form == document.form:
        return Converted(replace(document, file=file))
    said = form_named(document.form).comments_in(document)
    doors = form_named(form)
    written = doors.parse(doors.write(document.values, said), file)
    return Converted(written, 0 if form in HOLD_COMMENTS else len(said))


def _must_be_single(document: Document, form: str) -> None:
    """Raise ConvertError for a key that is written twice, because only one value would be
    written.
    """
    for path, places in document.duplicates():
        raise ConvertError(
            f"{'/'.join(path)} is written {len(places)} times, and {WORDS[form]} would keep the "
            "last alone",
            places[-1],
            "Keep one of them first (the quick fix of R01 keeps the last).",
        )
