"""``_imports``: State Branches that live in other files.

A file that is missing, cannot be read, leads back to itself or brings a name that is taken does
not keep the importing file from opening: it is a fault, with the chain of files, for inspection
(R08) to report. A file that is reached on two ways is read once.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from smsl_studio.blueprint.model import ImportFault, StateBranch
from smsl_studio.errors import ReadError
from smsl_studio.smsl.document import Document
from smsl_studio.smsl.files import read_document

KEY = "_imports"
Branches = dict[str, StateBranch]


@dataclass
class Imports:
    """What the imports of one file brought: SBs, the documents they stand in, and faults.

    ``own`` reads the SBs of one document.
    """

    own: Callable[[Document], Branches]
    branches: Branches = field(default_factory=dict)
    documents: dict[str, Document] = field(default_factory=dict)
    faults: list[ImportFault] = field(default_factory=list)
    _seen: set[str] = field(default_factory=set)

    def follow(self, document: Document, taken: Branches) -> None:
        """Read everything ``document`` imports, directly or not; ``taken`` names are its own."""
        here = os.path.realpath(document.file)
        self._seen.add(here)
        self._follow(document, (here,), (KEY,), taken)

    def _follow(
        self, document: Document, chain: tuple[str, ...], at: tuple[str, ...], taken: Branches
    ) -> None:
        """``at`` is the place, in the first document, of the import that led here."""
        listed: Any = document.values.get(KEY)
        if listed is None:
            return
        if not isinstance(listed, list):
            self._fault(at, "_imports is no list of files", chain)
            return
        for index, name in enumerate(listed):
            place = (KEY, str(index)) if len(chain) == 1 else at
            if not isinstance(name, str) or not name:
                self._fault(place, "an import is the name of a file", chain)
                continue
            written = os.path.join(os.path.dirname(document.file), name)  # noqa: PTH118, PTH120
            self._take(written, chain, place, taken)

    def _take(
        self, file: str, chain: tuple[str, ...], at: tuple[str, ...], taken: Branches
    ) -> None:
        real = os.path.realpath(file) if "\0" not in file else file
        if real in chain:
            self._fault(at, "the import leads back to a file it comes from", (*chain, real))
            return
        if real in self._seen:
            return
        self._seen.add(real)
        try:
            document = read_document(file)
            branches = self.own(document)
        except ReadError as error:
            self._fault(at, f"the import cannot be read ({error})", (*chain, real))
            return
        for name, branch in branches.items():
            if name in taken or name in self.branches:
                self._fault(at, f"the import brings {name}, which is there already", (*chain, real))
            else:
                self.branches[name] = branch
                self.documents[name] = document
        self._follow(document, (*chain, real), at, taken)

    def _fault(self, at: tuple[str, ...], sentence: str, chain: tuple[str, ...]) -> None:
        self.faults.append(ImportFault(at, sentence, tuple(map(os.path.basename, chain))))
