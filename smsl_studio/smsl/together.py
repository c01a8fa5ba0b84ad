"""Saves several files: all or none, even if the process dies in between.

1. A draft in the user's folder lists the files. The old bytes are kept beside each file
   (``.old``), and all new bytes are written beside it (``.part``).
2. The draft becomes a journal in one step. From here on the new bytes count.
3. The parts replace the files. The journal becomes a draft again, and all leftovers are removed.

If the process dies in step 1, the old bytes count. In steps 2 and 3 the new bytes count (see
``pending_saves``), and ``unfinished`` finishes the save. The folders are locked during the work.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

from smsl_studio.errors import FileChanged, SaveError
from smsl_studio.home import saving_folder
from smsl_studio.smsl.disk import held, settle, write_new
from smsl_studio.smsl.document import Document
from smsl_studio.smsl.document.limits import LARGEST_FILE
from smsl_studio.smsl.files import bytes_to_save, save_document
from smsl_studio.smsl.inputs import NOTHING, Seen, seen_at
from smsl_studio.smsl.outputs import put
from smsl_studio.smsl.pending_saves import (
    DRAFT,
    JOURNAL,
    PendingFile,
    PendingSave,
    digest_of_bytes,
    is_safe,
    pending_saves,
)
from smsl_studio.smsl.traits import traits_of
from smsl_studio.smsl.unfinished import FRESH, bring_back, clear, clear_up, end, finish, keep

PATIENCE = 5.0
"""The longest time (wall seconds) that a save waits for another one in the same folders."""

Pairs = Sequence[tuple[Document | str, str | os.PathLike[str]]]


@dataclass(frozen=True)
class _SavedFile:
    """One file of a save: its given name, its real path, its new bytes, and the file that its
    writer has seen (None: any file).
    """

    shown: str
    target: Path
    raw: bytes
    over: Seen | None


def save_together(pairs: Pairs, over: Mapping[str, Seen] | None = None) -> None:
    """Write several documents (or texts), each to its path: all or none.

    SaveError names the file that could not be written, with the reason. Then every file is as
    before. ``read_document`` finds all new or all old bytes, even if this process is killed. A
    symbolic link stays, and the file behind it keeps its mode.

    ``over`` has, by path, what was seen there when it was read. FileChanged if something else is
    there right before the replacement. An unfinished earlier save of one of these files is finished
    first.
    """
    files = _files(pairs, over or {})
    if len(files) < 2:
        for document, path in pairs[:1]:
            save_document(document, path, files[0].over)
        return
    folders = list(dict.fromkeys(file.target.parent for file in files))
    with _telling(files[0].shown):
        for save in _earlier(files):
            finish(save)
        for folder in folders:
            clear_up(folder)
        with held(folders, PATIENCE) as alone:
            if not alone:
                raise OSError(0, "another program is saving in the same folder")
            for _ in _earlier(files):
                raise OSError(0, "an earlier save of it has not come to its end")
            _save(files, folders)


def _files(pairs: Pairs, over: Mapping[str, Seen]) -> list[_SavedFile]:
    """Return the files to write, each once."""
    files: dict[Path, _SavedFile] = {}
    for document, path in pairs:
        shown = os.fspath(path)
        with _telling(shown):
            raw = bytes_to_save(document)
            file = _SavedFile(shown, Path(os.path.realpath(path)), raw, over.get(shown))
            if not file.target.parent.is_dir():
                raise FileNotFoundError(2, "there is no such folder")
            if len(raw) > LARGEST_FILE:
                raise OSError(27, f"it is larger than {LARGEST_FILE >> 20} MB")
            if file.raw != files.setdefault(file.target, file).raw:
                raise OSError(0, "it is to be written twice, with different texts")
    return list(files.values())


def _earlier(files: list[_SavedFile]) -> Iterator[PendingSave]:
    """Yield the unfinished saves of one of these files."""
    targets = {file.target for file in files}
    for save in pending_saves():
        if not targets.isdisjoint(file.target for file in save.files):
            yield save


def _save(files: list[_SavedFile], folders: list[Path]) -> None:
    token = os.urandom(6).hex()
    seen = []
    pending = []
    for index, file in enumerate(files):
        with _telling(file.shown):
            seen.append(_standing(file))
            before = None if seen[-1] == NOTHING else digest_of_bytes(seen[-1].raw)
            after = digest_of_bytes(file.raw)
            pending.append(PendingFile(file.target, token, index, before, after))
    draft = PendingSave(_records(files[0].shown) / f"{token}{DRAFT}", tuple(pending))
    journal = draft.renamed(JOURNAL)
    try:
        _write_record(draft)
        for file, one in zip(files, pending, strict=True):
            with _telling(file.shown):
                _prepare(file, one)
        settle(folders)
        draft.record.replace(journal.record)
    except BaseException:
        with suppress(OSError):
            journal.record.replace(draft.record)
        clear(draft)
        raise
    settle([journal.record.parent])
    for file, stood, one in zip(files, seen, pending, strict=True):
        try:
            put(one.part, one.target, stood, file.shown)
        except (OSError, FileChanged) as error:
            _undo(journal, file, error)
    end(journal)


def _standing(file: _SavedFile) -> Seen:
    """Return the file that is there now. FileChanged if its writer has seen another one."""
    traits_of(file.target)
    stood = seen_at(file.target, LARGEST_FILE)
    if len(stood.raw) > LARGEST_FILE:
        raise OSError(27, f"what stands there is larger than {LARGEST_FILE >> 20} MB")
    if file.over is not None and file.over != stood:
        raise FileChanged(file.shown)
    return stood


def _records(shown: str) -> Path:
    """Return the folder of this user's records, and create it if necessary. SaveError if it cannot
    be used.
    """
    folder = saving_folder()
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        if is_safe(folder):
            return folder
        reason = f"{folder} can be written by others, or is no folder of yours"
    except OSError as error:
        reason = f"{folder} cannot be made ({error.strerror})"
    raise SaveError(
        f"{shown} was not saved: {reason}",
        advice="Saving several files at once needs that folder. Give it to yourself alone, or set "
        "SMSL_STUDIO_HOME to another folder of yours.",
    )


def _write_record(draft: PendingSave) -> None:
    fresh = draft.record.with_suffix(FRESH)
    try:
        write_new(fresh, draft.encoded(), 0o600)
        fresh.replace(draft.record)
    except BaseException:
        with suppress(OSError):
            fresh.unlink()
        raise
    settle([draft.record.parent])


def _prepare(file: _SavedFile, pending: PendingFile) -> None:
    """Write the old and the new bytes beside one file."""
    traits = traits_of(file.target)
    if traits is not None:
        keep(file.target, pending.old, traits)
    write_new(pending.part, file.raw, traits)


def _undo(journal: PendingSave, file: _SavedFile, error: OSError | FileChanged) -> NoReturn:
    """Bring back all old bytes, because one part could not replace its file."""
    try:
        bring_back(journal)
    except OSError:
        raise SaveError(
            f"{file.shown} cannot be replaced: {getattr(error, 'strerror', None) or error}",
            advice="What was saved stands beside the files, and takes their places with the next "
            "save of one of them. Studio reads it already.",
        ) from error
    if isinstance(error, FileChanged):
        raise error
    raise _refused(file.shown, error) from error


@contextmanager
def _telling(shown: str) -> Iterator[None]:
    """Turn an error of the system into a SaveError with the name of the file."""
    try:
        yield
    except (OSError, ValueError) as error:
        raise _refused(shown, error) from error


def _refused(shown: str, error: Exception) -> SaveError:
    reason = getattr(error, "strerror", None) or str(error)
    return SaveError(
        f"{shown} was not saved: {reason}",
        advice="No file was changed. Free some room, or save elsewhere.",
    )
