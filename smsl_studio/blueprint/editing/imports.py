"""Edits of a file's ``_imports``: the other files with its State Branches."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import Any

from smsl_studio.blueprint.editing.draft import Draft, document_named
from smsl_studio.blueprint.imported_files import KEY
from smsl_studio.blueprint.meaning import word_for_word
from smsl_studio.blueprint.model import Blueprint, ImportFault
from smsl_studio.errors import EditRefused

Json = Any


def set_imports(blueprint: Blueprint, files: Sequence[Json], file: str | None = None) -> Blueprint:
    """Set the imports of a document (its own, or ``file``). An empty list removes them.

    The names are relative to the document. EditRefused if a new name leads to nothing that can be
    imported. Names that were there before are not checked again.
    """
    document = document_named(blueprint, file)
    written = document.values.get(KEY, [])
    if not isinstance(written, list):
        raise EditRefused(
            f"{KEY} is no list, so nothing can be added to it",
            document.place((KEY,)),
            f"Write {KEY} as [ ... ] in the text.",
        )
    draft = Draft(blueprint)
    before, after = (Counter(map(word_for_word, names)) for names in (written, files))
    for name in files:
        word = word_for_word(name)
        if after[word] > max(1, before[word]):
            raise EditRefused(f"{name} is imported already", advice="Import it once.")
        if word not in before and not (isinstance(name, str) and name.strip()):
            raise EditRefused("an import is the name of a file", advice="Choose a file.")
    if files:
        draft.file(document)[KEY] = list(files)
    else:
        draft.file(document).pop(KEY, None)
    edited = draft.done()
    known = set(map(_with_chain, blueprint.import_faults))
    new = (one for one in edited.import_faults if _with_chain(one) not in known)
    fault = next(new, None)
    if fault is not None and len(files) > len(written):
        raise EditRefused(_with_chain(fault), advice=fault.advice)
    return edited


def _with_chain(fault: ImportFault) -> str:
    return f"{fault.sentence} ({' > '.join(fault.chain)})"
