"""Moves a document to another folder: its imports get names from there."""

from __future__ import annotations

import os
from typing import Any

from smsl_studio.blueprint.imported_files import KEY
from smsl_studio.blueprint.project import (
    project_of,
    real_path,
    refusal_of_name,
    refusal_of_place,
)
from smsl_studio.errors import ConvertError
from smsl_studio.smsl.document import Document
from smsl_studio.smsl.splice import reconcile


def relocated(document: Document, file: str | os.PathLike[str]) -> Document:
    """Return the document with names of imports that are right from the folder of ``file``.

    The same object is returned if the folder stays or nothing is imported. Absolute names stay.
    ConvertError if an import is allowed from here and would not be allowed from there (see
    ``project``).
    """
    listed: Any = document.values.get(KEY)
    old, new = _folder(document.file), _folder(os.fspath(file))
    if old == new or not isinstance(listed, list):
        return document
    names = [_from(old, new, name) if isinstance(name, str) else name for name in listed]
    for index, pair in enumerate(zip(listed, names, strict=True)):
        _must_stay(document, os.fspath(file), *pair, index)
    return reconcile(document, {**document.values, KEY: names})


def _must_stay(document: Document, file: str, before: Any, after: Any, index: int) -> None:
    """Raise ConvertError if an import that is allowed now would not be allowed from another
    file.
    """
    if not isinstance(before, str) or before == after or refusal_of_name(before):
        return
    real = real_path(os.path.join(os.path.dirname(document.file), before))  # noqa: PTH118, PTH120
    refusal = refusal_of_place(real, project_of(file))
    if refusal and not refusal_of_place(real, project_of(document.file)):
        raise ConvertError(
            f"{file} cannot import {before}: from there {refusal.sentence}",
            document.place((KEY, str(index))),
            refusal.advice,
        )


def _folder(file: str) -> str:
    return os.path.realpath(os.path.dirname(file))  # noqa: PTH120


def _from(old: str, new: str, name: str) -> str:
    if not name or os.path.isabs(name) or "\0" in name:  # noqa: PTH117
        return name
    try:
        found = os.path.relpath(os.path.join(old, name), new)  # noqa: PTH118
    except ValueError:  # on another drive
        return os.path.join(old, name)  # noqa: PTH118
    return found.replace(os.sep, "/")
