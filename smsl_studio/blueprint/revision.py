"""The blueprint after a change of its documents. All changes go through this module."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import partial

from smsl_studio.blueprint.imported_files import KEY, Imports
from smsl_studio.blueprint.imports import follow, gather
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.project import real_path
from smsl_studio.blueprint.reading import branches_of
from smsl_studio.errors import UsageError
from smsl_studio.smsl.document import Document
from smsl_studio.smsl.document.likeness import same


def with_document(blueprint: Blueprint, document: Document) -> Blueprint:
    """Return the blueprint with ``document`` in place of its document with the same ``file``.

    Only the changes are read again. If its ``_imports`` changed, they are followed again, but
    documents in memory are not read from disk. ReadError if the document cannot be part of a
    blueprint. UsageError if it does not belong to this one. It may also be a file that could not be
    imported before.
    """
    for before in blueprint.documents:
        if before.file == document.file:
            if before.text == document.text:
                return blueprint
            return revised(blueprint, {before: _with_former_values(before, document)})
    return _with_import(blueprint, document)


def imported_anew(blueprint: Blueprint) -> Blueprint:
    """Return the blueprint with all imports that failed before and now lead to a file.

    Documents in memory are not read again.
    """
    imports = follow(blueprint.document, blueprint.imports.known if blueprint.imports else {})
    return gather(blueprint.document, imports, partial(branches_of, former=blueprint))


def revised(former: Blueprint, changed: Mapping[Document, Document]) -> Blueprint:
    """Return the blueprint with changed documents. ``changed`` maps each former document to its new
    one.
    """
    read = {after: branches_of(after, former) for after in changed.values()}

    def own(document: Document) -> dict[str, StateBranch]:
        """Return the SBs of one document. A changed document was read before."""
        return read[document] if document in read else branches_of(document, former)

    document = changed.get(former.document, former.document)
    if KEY not in document.values:
        return Blueprint(own(document), document, document.fields)
    imports = former.imports.swapped(changed) if former.imports else None
    if imports is None or any(_leads_elsewhere(*pair) for pair in changed.items()):
        imports = follow(document, imports.known if imports else {})
    return gather(document, imports, own)


def _with_import(blueprint: Blueprint, document: Document) -> Blueprint:
    own = partial(branches_of, former=blueprint)
    own(document)
    before = blueprint.imports or Imports("")
    real = real_path(document.file)
    imports = follow(blueprint.document, {**before.known, real: document})
    if real not in imports.known:
        raise UsageError(f"{document.file} is no file of this blueprint")
    return gather(blueprint.document, imports, own)


def _with_former_values(before: Document, document: Document) -> Document:
    """Return the document with the former objects for all values that equal the former ones."""
    values = dict(document.values)
    for key, value in values.items():
        former = before.values.get(key)
        # The first comparison is fast, and the second one exact (order of keys, 1 and true).
        if former == value and same(former, value):
            values[key] = former
    return replace(document, values=values)


def _leads_elsewhere(before: Document, after: Document) -> bool:
    return not same(before.values.get(KEY), after.values.get(KEY))
