"""``_imports``: State Branches that live in other files.

A file that is missing, cannot be read, leads back to itself or brings a name that is taken does
not keep the importing file from opening: it is a fault, with the chain of files, for inspection
(R08) to report. A file that is reached on two ways is read once.

Two steps: ``follow`` finds the files, and reads those that are not in memory yet; ``gather`` makes
one blueprint of what stands in them. An edit that leaves every ``_imports`` alone needs only the
second.
"""

from __future__ import annotations

import os
import stat
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

from smsl_studio.blueprint.model import Blueprint, ImportFault, StateBranch
from smsl_studio.blueprint.reading import fields_of
from smsl_studio.errors import ReadError
from smsl_studio.smsl.document import Document, Path
from smsl_studio.smsl.files import read_document

KEY = "_imports"
MOST = 500
"""So many files are imported in all; who needs more has made a mistake, or a trap."""

MOST_WRITTEN = 20_000
"""So many entries of all lists are looked at; files on several ways count once for each."""

Branches = dict[str, StateBranch]


@dataclass(frozen=True)
class Import:
    """A file that was reached: by which files (real paths, its own last), and where the last but
    one of them names it.
    """

    document: Document
    chain: tuple[str, ...]
    path: Path


@dataclass(frozen=True)
class Failure:
    """An import that led to no document; the chain ends with what it leads to."""

    sentence: str
    home: str
    path: Path
    chain: tuple[str, ...]


@dataclass(frozen=True)
class Imports:
    """What the imports of one file lead to, in the order in which SBs come; ``root`` is its own
    real path.
    """

    root: str
    files: tuple[Import, ...] = ()
    failures: tuple[Failure, ...] = ()

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


def real_path(file: str) -> str:
    """What tells whether two names are one file."""
    try:
        return os.path.realpath(file)
    except (OSError, ValueError):
        return file


def follow(document: Document, known: Mapping[str, Document]) -> Imports:
    """Find everything that ``document`` imports, directly or not.

    A file in ``known`` (by its real path) is taken as it is there; any other is read.
    """
    root = real_path(document.file)
    files: list[Import] = []
    failures: list[Failure] = []
    seen = {root}
    asked = 0
    waiting = list(_listed(document, (root,), failures))[::-1]
    while waiting:
        path, written, chain = waiting.pop()
        asked += 1
        if len(files) == MOST or asked > MOST_WRITTEN:
            words = f"more than {MOST if len(files) == MOST else MOST_WRITTEN} imports"
            failures.append(Failure(f"{words} are not followed", chain[-1], path, chain))
            break
        real = real_path(written)
        if real in chain:
            words = "the import leads back to a file it comes from"
            failures.append(Failure(words, chain[-1], path, (*chain, real)))
            continue
        if real in seen:
            continue
        seen.add(real)
        try:
            found = known[real] if real in known else _read(written, real)
        except ReadError as error:
            words = f"the import cannot be read ({error})"
            failures.append(Failure(words, chain[-1], path, (*chain, real)))
            continue
        files.append(Import(found, (*chain, real), path))
        waiting.extend(list(_listed(found, (*chain, real), failures))[::-1])
    return Imports(root, tuple(files), tuple(failures))


def gather(document: Document, imports: Imports, own: Callable[[Document], Branches]) -> Blueprint:
    """One blueprint of a document and what it imports; ``own`` reads the SBs of one document."""
    branches = dict(own(document))
    homes: dict[str, Document] = {}
    known = {imports.root: document, **imports.known}
    faults = [_fault(known, item) for item in imports.failures]
    for item in imports.files:
        at = (item.chain[-2], item.path, item.chain)
        try:
            brought = own(item.document)
        except ReadError as error:
            faults.append(_fault(known, Failure(f"the import cannot be read ({error})", *at)))
            continue
        for name, branch in brought.items():
            if name in branches:
                words = f"the import brings {name}, which is there already"
                faults.append(_fault(known, Failure(words, *at)))
            else:
                branches[name] = branch
                homes[name] = item.document
    return Blueprint(branches, document, fields_of(document), homes, tuple(faults), imports)


def _listed(
    document: Document, chain: tuple[str, ...], failures: list[Failure]
) -> Iterator[tuple[Path, str, tuple[str, ...]]]:
    """Where each import of a document is written, the file it means, and the way to it."""
    listed: Any = document.values.get(KEY)
    if listed is None:
        return
    if not isinstance(listed, list):
        failures.append(Failure("_imports is no list of files", chain[-1], (KEY,), chain))
        return
    folder = os.path.dirname(document.file)  # noqa: PTH120
    for index, name in enumerate(listed[: MOST_WRITTEN + 1]):
        path = (KEY, str(index))
        if isinstance(name, str) and name:
            yield path, os.path.join(folder, name), chain  # noqa: PTH118
        else:
            failures.append(Failure("an import is the name of a file", chain[-1], path, chain))


def _read(written: str, real: str) -> Document:
    """The document in a file, under the plainest name that leads to it.

    Only an ordinary file is read: a device or a pipe may never end.
    """
    plain = os.path.normpath(written) if "\0" not in written else written
    file = plain if real_path(plain) == real else written
    try:
        odd = not stat.S_ISREG(os.stat(file).st_mode)  # noqa: PTH116
    except (OSError, ValueError):
        odd = False
    if odd:
        raise ReadError(f"{file} is no ordinary file")
    return read_document(file)


def _fault(known: Mapping[str, Document], failure: Failure) -> ImportFault:
    chain = tuple(map(os.path.basename, failure.chain))
    return ImportFault(failure.path, failure.sentence, chain, known[failure.home])
