"""Saving a blueprint under another name: in the form of the new name, with imports adjusted."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path

from smsl_studio.blueprint.relocation import relocated
from smsl_studio.errors import ConvertError, SaveError
from smsl_studio.smsl.conversion import convert, converted
from smsl_studio.smsl.document import WORDS, Document
from smsl_studio.smsl.forms import SUFFIXES, form_of


@dataclass(frozen=True)
class Moved:
    """The document to be written. ``anew`` says that its text changed."""

    document: Document
    anew: bool


def moved(document: Document, path: Path, whole: bool = True) -> Moved:
    """A document under another name; raises ConvertError if the other form cannot express it.

    ``whole`` is False for a text that cannot be read. It can only be saved in its own form.
    """
    if not whole:
        return _as_it_is(document, path)
    found = relocated(document, path)
    form = form_of(str(path), found.text)
    if form == found.form:
        return Moved(replace(found, file=str(path)), found is not document)
    return Moved(convert(found, form, str(path)).document, True)


def stepped(document: Document, path: Path) -> Document:
    """The document of an older step, after the file was saved under another name.

    Of a key that is written twice only the last value is kept, if the form has no such keys. This
    is the value that counts, so the step means the same as before. An import that is not allowed
    from the new folder keeps its name, and a finding says so. ConvertError is raised if the form
    cannot express a value.
    """
    with suppress(ConvertError):
        document = relocated(document, path)
    return converted(document, form_of(str(path), document.text), str(path)).document


def _as_it_is(document: Document, path: Path) -> Moved:
    if SUFFIXES.get(path.suffix.lower(), document.form) != document.form:
        raise ConvertError(
            f"a text that cannot be read cannot be saved as {form_words(path, document)}",
            advice="Repair the text first, or save it in its own form.",
        )
    return Moved(replace(document, file=str(path)), False)


def form_words(path: Path, document: Document) -> str:
    """The name of the form in which the document would be written to ``path``."""
    return WORDS[form_of(str(path), document.text)]


def leaves_comments(document: Document, path: Path) -> bool:
    """Whether the form of the new name would lose comments of the text."""
    form = form_of(str(path), document.text)
    if form == document.form:
        return False
    try:
        return convert(document, form, str(path)).comments_left > 0
    except ConvertError:  # the save itself reports it
        return False


def over_an_import(target: str) -> SaveError:
    """The refusal of a save over a file that the blueprint imports."""
    return SaveError(
        f"the blueprint imports {target}, and would take its place",
        advice="Save under another name.",
    )
