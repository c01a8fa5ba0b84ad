"""One document in another written form: the same values, and its comments where it can hold any."""

from __future__ import annotations

from dataclasses import dataclass, replace

from smsl_studio.errors import ConvertError
from smsl_studio.smsl.comments import NO_COMMENTS, Comments
from smsl_studio.smsl.document import Document
from smsl_studio.smsl.forms import WORDS, form_named


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
    said = _comments(document)
    doors = form_named(form)
    text = doors.write(document.values)
    if not len(said):
        return Converted(doors.parse(text, file))
    if form == "yaml":
        from smsl_studio.smsl.yaml_form import write

        return Converted(doors.parse(write(document.values, said), file))
    if form == "smsl":
        from smsl_studio.smsl.native_form.comments import with_comments

        return Converted(doors.parse(with_comments(text, said), file))
    return Converted(doors.parse(text, file), len(said))


def _comments(document: Document) -> Comments:
    if document.form == "yaml":
        from smsl_studio.smsl import yaml_form

        return yaml_form.comments_in(document)
    if document.form == "smsl":
        from smsl_studio.smsl.native_form.comments import comments_in

        return comments_in(document)
    return NO_COMMENTS


def _must_be_single(document: Document, form: str) -> None:
    """Refuse what is written twice: only the winner would be written, and the rest be lost."""
    for path, places in document.duplicates():
        raise ConvertError(
            f"{'/'.join(path)} is written {len(places)} times, and {WORDS[form]} would keep the "
            "last alone",
            places[-1],
            "Keep one of them first (the quick fix of R01 keeps the last).",
        )
