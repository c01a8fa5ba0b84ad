"""Files that are imported no longer, and the unsaved text in them: it stays with the work.

Whether an import stands in a text or not says nothing of what was typed in the imported file. Its
document goes aside with the step (or the undo) that takes the import out, comes back with the one
that puts it in again, and is among what is saved in between.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.revision import with_document
from smsl_studio.smsl.document import Document

Aside = Mapping[str, Document]
Unsaved = Callable[[Document], bool]
"""Whether the text of a document stands nowhere else."""
NOTHING: Aside = MappingProxyType({})


def put_aside(before: Blueprint, after: Blueprint, aside: Aside, unsaved: Unsaved) -> Aside:
    """What is aside when ``after`` takes the place of ``before``."""
    if before.documents[1:] == after.documents[1:] and not aside:
        return NOTHING
    here = {document.file for document in after.documents}
    left = {**aside, **{document.file: document for document in before.documents[1:]}}
    return {file: one for file, one in left.items() if file not in here and unsaved(one)}


def brought_back(after: Blueprint, aside: Aside, unsaved: Unsaved) -> Blueprint:
    """The blueprint with the unsaved texts of files that it imports again."""
    if aside:
        for document in after.documents[1:]:
            waiting = aside.get(document.file)
            if waiting is not None and unsaved(waiting):
                after = with_document(after, waiting)
    return after
