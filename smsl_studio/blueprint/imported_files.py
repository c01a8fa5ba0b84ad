"""The files that a blueprint imports, as values: which were reached, and which were not.

``imports`` finds them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from smsl_studio.smsl.document import Document, Path

KEY = "_imports"
"""The field of a file that names the files it imports."""


@dataclass(frozen=True)
class Import:
    """A file that was reached: by which files (real paths, its own last), and where the last but
    one of them names it.
    """

    document: Document
    chain: tuple[str, ...]
    path: Path


@dataclass(frozen=True)
class ImportFailure:
    """An import that led to no document; the chain ends with what it leads to.

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
    """What the imports of one file lead to, in the order in which SBs come; ``root`` is its own
    real path.
    """

    root: str
    files: tuple[Import, ...] = ()
    failures: tuple[ImportFailure, ...] = ()

    @property
    def known(self) -> dict[str, Document]:
        """The documents by their real paths."""
        return {item.chain[-1]: item.document for item in self.files}

    def swapped(self, documents: Mapping[Document, Document]) -> Imports:
        """The same files with other texts: the former document to the one that it is now."""
        if not any(item.document in documents for item in self.files):
            return self
        files = (
            replace(item, document=documents.get(item.document, item.document))
            for item in self.files
        )
        return replace(self, files=tuple(files))
