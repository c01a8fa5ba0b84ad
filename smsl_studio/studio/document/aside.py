"""Documents set aside: files that are no longer imported, but have unsaved text.

Removing an import from a text must not lose what was typed in the imported file. The step (or undo)
that removes the import sets its document aside. The step that imports it again brings it back. In
between it is saved together with the other files.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.revision import with_document
from smsl_studio.smsl.document import Document

Aside = Mapping[str, Document]
Unsaved = Callable[[Document], bool]
"""Tells whether the text of a document exists nowhere else, so that it would be lost."""
NOTHING: Aside = MappingProxyType({})


def put_aside(before: Blueprint, after: Blueprint, aside: Aside, unsaved: Unsaved) -> Aside:
    """The documents that are set aside when ``after`` replaces ``before``."""
    if before.documents[1:] == after.documents[1:] and not aside:
        return NOTHING
    here = {document.file for document in after.documents}
    left = {**aside, **{document.file: document for document in before.documents[1:]}}
    return {file: one for file, one in left.items() if file not in here and unsaved(one)}


def brought_back(after: Blueprint, aside: Aside, unsaved: Unsaved) -> Blueprint:
    """``after`` with the unsaved texts of files that it imports again."""
    if aside:
        for document in after.documents[1:]:
            waiting = aside.get(document.file)
            if waiting is not None and unsaved(waiting):
                after = with_document(after, waiting)
    return after
