"""The files that a blueprint imports, as values: those that were found, and those that were not.

``imports`` finds them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from smsl_studio.smsl.document import Document, Path

KEY = "_imports"
"""The field of a file that names its imports."""


@dataclass(frozen=True)
class Import:
    """A file that was found. ``chain`` has the files that led to it (real paths, its own last).
    ``path`` is the place of its name in the file before it.
    """

    document: Document
    chain: tuple[str, ...]
    path: Path
    stored: str = ""
    """The closure digest by which it was found in the user's store, empty for any other file."""


@dataclass(frozen=True)
class ImportFailure:
    """An import that led to no document. The chain ends with the target.

    ``wanted`` is the real path of a file that would be imported if it could be read.
    """

    sentence: str
    home: str
    path: Path
    chain: tuple[str, ...]
    advice: str
    wanted: str = ""


@dataclass(frozen=True)
class Imports:
    """All files that one file imports, in the order of their SBs. ``root`` is its own real path."""

    root: str
    files: tuple[Import, ...] = ()
    failures: tuple[ImportFailure, ...] = ()

    @property
    def known(self) -> dict[str, Document]:
        """The documents by their real paths."""
        return {item.chain[-1]: item.document for item in self.files}

    def swapped(self, documents: Mapping[Document, Document]) -> Imports:
        """Return the same files with other texts. The keys are the former documents."""
        if not any(item.document in documents for item in self.files):
            return self
        files = (
            replace(item, document=documents.get(item.document, item.document))
            for item in self.files
        )
        return replace(self, files=tuple(files))
