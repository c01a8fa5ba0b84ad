"""``_imports``: State Branches in other files.

A file may be missing or unreadable, may lead back to itself, or may bring a name that is taken. The
importing file still opens. The fault is kept with the chain of files, and inspection reports it
(R08). A file that several files import is read once.

``project`` says which files may be imported. ``follow`` finds the files and reads those that are
not in memory. ``gather`` makes one blueprint of their contents. An edit that changes no
``_imports`` needs only ``gather``.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import PurePath
from typing import Any

from smsl_studio.blueprint.imported_files import KEY, Import, ImportFailure, Imports
from smsl_studio.blueprint.model import Blueprint, ImportFault, StateBranch
from smsl_studio.blueprint.project import project_of, real_path, refusal_of_name, refusal_of_place
from smsl_studio.blueprint.stored import (
    PREFIX,
    digest_named,
    project_in_store,
    stored_file,
    stored_place,
)
from smsl_studio.errors import Place, ReadError
from smsl_studio.smsl.document import Document, Path
from smsl_studio.smsl.document.budget import share_of_budget
from smsl_studio.smsl.document.limits import MAX_BRANCHES, MAX_VALUES, TOO_MANY_BRANCHES
from smsl_studio.smsl.files import content_of, document_of

MOST = 500
"""The largest number of imported files. More are a mistake or an attack."""

MOST_WRITTEN = 20_000
"""The largest number of entries of all lists that are read. A file on several paths counts each
time.
"""

SHOWN = 200
"""The largest number of characters that are shown of a name that leads to nothing."""

Branches = dict[str, StateBranch]


def follow(document: Document, known: Mapping[str, Document]) -> Imports:
    """Find everything that ``document`` imports, directly or not, within its project, and what it
    names in the user's store.

    A file in ``known`` (by its real path) is used as it is in memory. Any other file is read.
    """
    root = real_path(document.file)
    project = project_in_store(document.file) or project_of(document.file)
    files: list[Import] = []
    failures: list[ImportFailure] = []
    seen: set[object] = {root}
    asked, share = 0, share_of_budget(document)
    waiting = list(_listed(document, (root,), project, failures))[::-1]
    while waiting:
        entry = waiting.pop()
        asked += 1
        if most := _too_many(files, failures, asked, share):
            failures.append(entry.failure(most, "Import fewer files."))
            break
        try:
            real = _place_of(entry)
        except _Refused as refused:
            if (entry.home, entry.name) not in seen:
                seen.add((entry.home, entry.name))
                failures.append(entry.failure(*refused.args))
            continue
        if real in entry.chain:
            words = "the import leads back to a file it comes from"
            failures.append(entry.failure(words, "Leave out one of these imports.", real))
            continue
        if real in seen:
            continue
        seen.add(real)
        try:
            found = known[real] if real in known else _read(entry, real)
        except _Refused as refused:
            sentence, advice = refused.args
            failures.append(replace(entry.failure(sentence, advice, real), wanted=real))
            continue
        chain = (*entry.chain, real)
        files.append(Import(found, chain, entry.path, entry.stored))
        share += share_of_budget(found)
        inside = project_in_store(real) if entry.stored else entry.project
        waiting.extend(list(_listed(found, chain, inside, failures))[::-1])
    return Imports(root, tuple(files), tuple(failures))


def named_document(home: Document, name: str) -> Document:
    """Return the file to which a name in ``home`` leads, with the rules of imports.

    ReadError if it must not be read, or cannot be.
    """
    own = real_path(home.file)
    project = project_in_store(own) or project_of(home.file)
    entry = _Entry(name, os.path.dirname(home.file), (), (own,), project)  # noqa: PTH120
    try:
        real = _place_of(entry)
        if real == own:
            raise _Refused("it leads back to its own file", "Name another file.")
        return _read(entry, real)
    except _Refused as refused:
        sentence, advice = refused.args
        raise ReadError(sentence.replace("the import", "the file", 1), None, advice) from None


def gather(document: Document, imports: Imports, own: Callable[[Document], Branches]) -> Blueprint:
    """Return one blueprint of a document and its imports. ``own`` reads the SBs of one document."""
    branches = dict(own(document))
    homes: dict[str, Document] = {}
    known = {imports.root: document, **imports.known}
    faults = [_fault(known, item) for item in imports.failures]
    for item in imports.files:
        at = (item.chain[-2], item.path, item.chain)
        try:
            brought = own(item.document)
        except ReadError as error:
            words, advice = _no_blueprint(error, item.document.file)
            faults.append(_fault(known, ImportFailure(words, *at, advice)))
            continue
        if len(branches) + len(brought) > MAX_BRANCHES:
            faults.append(
                _fault(known, ImportFailure(TOO_MANY_BRANCHES[0], *at, TOO_MANY_BRANCHES[1]))
            )
            continue
        for name, branch in brought.items():
            if name in branches:
                words = f"the import brings {name}, which is there already"
                faults.append(_fault(known, ImportFailure(words, *at, "Rename one of the two.")))
            else:
                branches[name] = branch
                homes[name] = item.document
    return Blueprint(branches, document, document.fields, homes, tuple(faults), imports)


class _Refused(Exception):  # noqa: N818
    """An import that must not be followed, with a sentence and an advice."""


@dataclass(frozen=True)
class _Entry:
    """One name in a list of imports: where it is written, and the files that led there."""

    name: str
    folder: str
    path: Path
    chain: tuple[str, ...]
    project: str
    """The folder that must contain the file."""

    @property
    def stored(self) -> str:
        """The digest in ``store:DIGEST``, empty for a name in the project."""
        return digest_named(self.name)

    @property
    def home(self) -> str:
        """The file with the name, by its real path."""
        return self.chain[-1]

    def failure(self, sentence: str, advice: str, end: str = "") -> ImportFailure:
        """Return the failure of this import. ``end`` is the target, if it is known."""
        return ImportFailure(
            sentence, self.home, self.path, (*self.chain, end or self.name), advice
        )


def _listed(
    document: Document, chain: tuple[str, ...], project: str, failures: list[ImportFailure]
) -> Iterator[_Entry]:
    """Yield each import that a document names. Wrong entries are added to ``failures``."""
    listed: Any = document.values.get(KEY)
    if listed is None:
        return
    if not isinstance(listed, list):
        words = "_imports is no list of files"
        failures.append(ImportFailure(words, chain[-1], (KEY,), chain, 'Write ["other.json"].'))
        return
    folder = os.path.dirname(document.file)  # noqa: PTH120
    for index, name in enumerate(listed[: MOST_WRITTEN + 1]):
        path = (KEY, str(index))
        if isinstance(name, str) and name:
            yield _Entry(name, folder, path, chain, project)
        else:
            words = "an import is the name of a file"
            failures.append(ImportFailure(words, chain[-1], path, chain, "Write it in quotes."))


def _too_many(files: list[Import], failures: list[ImportFailure], asked: int, share: int) -> str:
    """Return why no more imports are followed, or the empty text."""
    if share > MAX_VALUES:
        return f"the files hold more than {MAX_VALUES:,} names and values together"
    if len(files) == MOST or asked > MOST_WRITTEN:
        return f"more than {MOST if len(files) == MOST else MOST_WRITTEN} imports are not followed"
    return f"more than {MOST} imports fail" if len(failures) >= MOST else ""


def _place_of(entry: _Entry) -> str:
    """Return the real path of an import. _Refused if it must not be imported."""
    if entry.name.startswith(PREFIX):
        return _place_in_store(entry)
    refusal = refusal_of_name(entry.name)
    if refusal is None:
        real = real_path(os.path.join(entry.folder, entry.name))  # noqa: PTH118
        refusal = refusal_of_place(real, entry.project)
        if refusal is None:
            return real
    raise _Refused(refusal.sentence, refusal.advice)


def _place_in_store(entry: _Entry) -> str:
    if not entry.stored:
        words = "the import names no digest of the store"
        raise _Refused(words, "Write store: and the closure digest that store list shows.")
    real = stored_file(entry.stored)
    place = stored_place(real) if real else None
    if place is None or place.digest != entry.stored:
        words = "the import is not in the store of this user"
        raise _Refused(words, "Add it with smsl-studio store add FILE.")
    return real


def _read(entry: _Entry, real: str) -> Document:
    """Return the document in a file, under the simplest name that leads to it.

    A message names the place of a fault and never the content there, because the file may be any.
    """
    written = real if entry.stored else os.path.join(entry.folder, entry.name)  # noqa: PTH118
    project = project_in_store(real) if entry.stored else entry.project
    plain = os.path.normpath(written)
    file = plain if real_path(plain) == real else written
    try:
        content = content_of(real, project)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or "it has no possible name"
        advice = "Import a file that is there, or leave it out."
        raise _Refused(f"the import cannot be read: {reason}", advice) from None
    try:
        return document_of(content, file)
    except ReadError as error:
        raise _Refused(*_no_blueprint(error, file)) from None


def _no_blueprint(error: ReadError, file: str) -> tuple[str, str]:
    place = error.place or Place(file, 1, 1)
    return f"the import is no blueprint: {place}", "Open that file by itself to see why."


def _fault(known: Mapping[str, Document], failure: ImportFailure) -> ImportFault:
    chain = tuple(PurePath(name).name[:SHOWN] for name in failure.chain)
    return ImportFault(failure.path, failure.sentence, chain, known[failure.home], failure.advice)
