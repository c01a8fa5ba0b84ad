"""Saving several files: all or none, whatever happens in between.

1. Every file gets its marker, which names the journal of the save; what stands there now is kept
   beside it (``.old``), and all new bytes are written beside it (``.part``).
2. The journal appears under its name in one step: from here on the new bytes count.
3. The parts take their places, the journal goes, then all that is left.

A process that dies in 1 leaves old bytes that count, in 2 and 3 new ones (see ``pending``);
``finish_saves`` brings to its end what it left. The folders are held by who works in them.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

from smsl_studio.errors import SaveError
from smsl_studio.smsl.disk import held, mode_of, settle, write_new
from smsl_studio.smsl.document import Document
from smsl_studio.smsl.files import bytes_to_save, save_document
from smsl_studio.smsl.pending import Marker, digest_at, journal_path, marker_of
from smsl_studio.smsl.unfinished import bring_back, clear, end, finish_saves, keep, listing

PATIENCE = 5.0
"""So long (wall seconds) a save waits for another one in the same folders."""


@dataclass(frozen=True)
class _File:
    """One file of a save: its name as it was given, its real path, its new bytes."""

    shown: str
    target: Path
    raw: bytes


def save_together(pairs: Sequence[tuple[Document | str, str | os.PathLike[str]]]) -> None:
    """Write the bytes of several documents (or plain texts), each to its path: all or none.

    SaveError names the file that could not be written, and why; then every file is as it was.
    Whoever reads them through ``read_document`` sees all new or all old bytes, also where this
    process is killed. A symbolic link keeps pointing, and the file behind it keeps its mode.
    """
    files = _files(pairs)
    if len(files) < 2:
        for document, path in pairs[:1]:
            save_document(document, path)
        return
    folders = list(dict.fromkeys(file.target.parent for file in files))
    with _telling(files[0].shown):
        for folder in folders:
            finish_saves(folder)
        with held(folders, PATIENCE) as alone:
            if not alone:
                raise OSError(0, "another program is saving in the same folder")
            _save(files, folders)


def _files(pairs: Sequence[tuple[Document | str, str | os.PathLike[str]]]) -> list[_File]:
    """The files to write, each once."""
    files: dict[Path, _File] = {}
    for document, path in pairs:
        shown = os.fspath(path)
        with _telling(shown):
            file = _File(shown, Path(os.path.realpath(path)), bytes_to_save(document))
            if not file.target.parent.is_dir():
                raise FileNotFoundError(2, "there is no such folder")
            if file.raw != files.setdefault(file.target, file).raw:
                raise OSError(0, "it is to be written twice, with different texts")
    return list(files.values())


def _save(files: list[_File], folders: list[Path]) -> None:
    journal = journal_path(folders[0], os.urandom(6).hex())
    fresh = journal.with_name(f"{journal.stem}-{len(files)}.part")
    markers: list[Marker] = []
    try:
        for index, file in enumerate(files):
            with _telling(file.shown):
                _prepare(file, journal, index, markers)
        write_new(fresh, listing(journal, markers))
        settle(folders)
        fresh.replace(journal)
    except BaseException:
        for path in (journal, fresh):
            with suppress(OSError):
                path.unlink()
        clear(markers)
        raise
    settle(folders[:1])
    for file, marker in zip(files, markers, strict=True):
        try:
            marker.part.replace(marker.target)
        except OSError as error:
            _undo(journal, markers, file, error)
    end(journal, markers)


def _prepare(file: _File, journal: Path, index: int, markers: list[Marker]) -> None:
    """Write what the save needs beside one file."""
    target = file.target
    earlier = marker_of(target)
    if earlier is not None and earlier.committed:
        raise OSError(0, "an earlier save of it has not come to its end")
    mode = mode_of(target)
    marker = Marker(target, journal, index, digest_at(target))
    with suppress(FileNotFoundError):
        marker.path.unlink()
    markers.append(marker)
    write_new(marker.path, marker.encoded())
    if mode is not None:
        keep(target, marker.old, mode)
    write_new(marker.part, file.raw, mode)


def _undo(journal: Path, markers: list[Marker], file: _File, error: OSError) -> NoReturn:
    """One part could not take its place: what stood there before comes back everywhere."""
    try:
        bring_back(journal, markers)
    except OSError:
        raise SaveError(
            f"{file.shown} cannot be replaced: {error.strerror or error}",
            advice="What was saved stands beside the files, and takes their places with the next "
            "save in this folder. Studio reads it already.",
        ) from error
    raise _refused(file.shown, error) from error


@contextmanager
def _telling(shown: str) -> Iterator[None]:
    """Let an error of the system say which file it keeps from being saved."""
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
