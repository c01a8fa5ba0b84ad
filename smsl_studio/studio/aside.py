"""Files that are imported no longer, and the unsaved text in them: it stays with the work.

Whether an import stands in a text or not says nothing of what was typed in the imported file. Its
document goes aside with the step that takes the import out, comes back with the step that puts it
in again, and is among what is saved in between.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.revising import with_document
from smsl_studio.smsl.document import Document

Aside = Mapping[str, Document]
Unsaved = Callable[[Document], bool]
"""Whether the text of a document stands nowhere else."""
NOTHING: Aside = MappingProxyType({})


def leaving(before: Blueprint, after: Blueprint, unsaved: Unsaved) -> Aside:
    """What was imported before, is not any more, and has unsaved text."""
    if before.documents[1:] == after.documents[1:]:
        return NOTHING
    here = {document.file for document in after.documents}
    return {one.file: one for one in before.documents[1:] if one.file not in here and unsaved(one)}


def put_aside(
    before: Blueprint, after: Blueprint, aside: Aside, unsaved: Unsaved
) -> tuple[Blueprint, Aside]:
    """What a step comes to, with the unsaved texts of files that it imports again; and what is
    aside after it.
    """
    if before.documents[1:] == after.documents[1:] and not aside:
        return after, NOTHING
    here = {document.file for document in after.documents}
    waiting = {file: one for file, one in aside.items() if unsaved(one)}
    kept = {**waiting, **leaving(before, after, unsaved)}
    for document in [kept.pop(file) for file in here & kept.keys()]:
        after = with_document(after, document)
    return after, kept or NOTHING
