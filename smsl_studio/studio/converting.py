"""Saving a blueprint under another name: in the form of the new name, its imports still found."""

from __future__ import annotations

import os
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from smsl_studio.errors import ConvertError
from smsl_studio.smsl.converting import convert
from smsl_studio.smsl.document import Document
from smsl_studio.smsl.forms import SUFFIXES, WORDS, form_of
from smsl_studio.smsl.splicing import reconcile

IMPORTS = "_imports"


@dataclass(frozen=True)
class Moved:
    """The document as it is to be written. ``anew`` says that it is no longer the same text, so
    that what stands in the history does not fit it.
    """

    document: Document
    anew: bool


def moved(document: Document, path: Path, whole: bool = True) -> Moved:
    """A document under another name; ConvertError where the other form has no spelling for it.

    A text that is not ``whole`` (it does not read) can only go on in its own form.
    """
    if not whole:
        return _as_it_is(document, path)
    found = _with_imports(document, path)
    form = form_of(str(path), found.text)
    if form == found.form:
        return Moved(replace(found, file=str(path)), found is not document)
    return Moved(convert(found, form, str(path)).document, True)


def _as_it_is(document: Document, path: Path) -> Moved:
    if SUFFIXES.get(path.suffix.lower(), document.form) != document.form:
        raise ConvertError(
            f"a text that does not read cannot be saved as {form_words(path, document)}",
            advice="Repair the text first, or save it in its own form.",
        )
    return Moved(replace(document, file=str(path)), False)


def form_words(path: Path, document: Document) -> str:
    """What people call the form in which the document would be written there."""
    return WORDS[form_of(str(path), document.text)]


def leaves_comments(document: Document, path: Path) -> bool:
    """Whether comments of the text would not come along into the form of the new name."""
    form = form_of(str(path), document.text)
    if form == document.form:
        return False
    try:
        return convert(document, form, str(path)).comments_left > 0
    except ConvertError:  # which is told when it is saved
        return False


def _with_imports(document: Document, path: Path) -> Document:
    """Imports are named from the folder of the file; from another folder they have other names."""
    listed: Any = document.values.get(IMPORTS)
    old, new = _folder(document.file), _folder(str(path))
    if old == new or not isinstance(listed, list):
        return document
    names = [_from(old, new, name) if isinstance(name, str) else name for name in listed]
    return reconcile(document, {**document.values, IMPORTS: names})


def _folder(file: str) -> str:
    return os.path.realpath(os.path.dirname(file))  # noqa: PTH120


def _from(old: str, new: str, name: str) -> str:
    if os.path.isabs(name) or "\0" in name:  # noqa: PTH117
        return name
    try:
        found = os.path.relpath(os.path.join(old, name), new)  # noqa: PTH118
    except ValueError:
        return os.path.join(old, name)  # noqa: PTH118
    return found.replace(os.sep, "/")
