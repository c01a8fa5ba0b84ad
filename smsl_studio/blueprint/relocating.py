"""A document that goes to another folder: its imports are named from there."""

from __future__ import annotations

import os
from typing import Any

from smsl_studio.blueprint.importing import KEY
from smsl_studio.smsl.document import Document
from smsl_studio.smsl.splicing import reconcile


def relocated(document: Document, file: str | os.PathLike[str]) -> Document:
    """The document as it has to read to stand at ``file`` and import what it imports now.

    Imports are named from the folder of the file that names them. The very same document where
    the folder stays or nothing is imported; absolute names stay.
    """
    listed: Any = document.values.get(KEY)
    old, new = _folder(document.file), _folder(os.fspath(file))
    if old == new or not isinstance(listed, list):
        return document
    names = [_from(old, new, name) if isinstance(name, str) else name for name in listed]
    return reconcile(document, {**document.values, KEY: names})


def _folder(file: str) -> str:
    return os.path.realpath(os.path.dirname(file))  # noqa: PTH120


def _from(old: str, new: str, name: str) -> str:
    if not name or os.path.isabs(name) or "\0" in name:  # noqa: PTH117
        return name
    try:
        found = os.path.relpath(os.path.join(old, name), new)  # noqa: PTH118
    except ValueError:  # another drive
        return os.path.join(old, name)  # noqa: PTH118
    return found.replace(os.sep, "/")
