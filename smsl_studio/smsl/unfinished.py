"""Saves of several files that a process has left unfinished: they are finished or undone."""

from __future__ import annotations

import os
import re
import stat
import time
from collections.abc import Iterable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

from smsl_studio.home import is_own, saving_folder
from smsl_studio.smsl.disk import held, settle, write_new
from smsl_studio.smsl.pending_saves import (
    DRAFT,
    PendingFile,
    PendingSave,
    pending_at,
    pending_saves,
)
from smsl_studio.smsl.traits import Traits

FRESH = ".fresh"
"""The suffix of a record that is being written."""

_OF_ONE = re.compile(r"\..+\.(?:json|smsl|ya?ml)\.[0-9a-f]{12}\.part", re.DOTALL | re.IGNORECASE)
_RECORD = re.compile(rf"[0-9a-f]{{12}}\{FRESH}")
_LONG_AGO = 3600.0
"""The time (s) without a change after which a leftover file is removed."""


def interrupted_saves(files: Iterable[str | os.PathLike[str]]) -> tuple[PendingSave, ...]:
    """Return the unfinished saves whose new bytes count for one of these files and are not in place
    yet.
    """
    wanted = {Path(os.path.realpath(file)) for file in files}
    found = []
    for save in pending_saves():
        if any(one.target in wanted and pending_at(one.target) for one in save.files):
            with _alone(save) as alone:
                found += [save] * alone
    return tuple(found)


def finish_saves(folder: str | os.PathLike[str]) -> tuple[Path, ...]:
    """Finish all saves of this user with files in a folder, and remove their leftovers.

    Return the files that were replaced.
    """
    finished: list[Path] = []
    with suppress(OSError, ValueError):
        place = Path(os.path.realpath(folder))
        for save in pending_saves():
            if place in save.folders:
                finished.extend(finish(save))
        clear_up(place)
    return tuple(finished)


def finish(save: PendingSave) -> tuple[Path, ...]:
    """Let the new bytes of a save replace the files. Return the replaced files.

    A file that somebody has changed since stays. A save of a living process is left alone.
    """
    finished: list[Path] = []
    with suppress(OSError), _alone(save) as alone:
        if alone:
            finished.extend(file.target for file in save.files if _take_place(file))
            end(save)
    return tuple(finished)


def undo(save: PendingSave) -> bool:
    """Bring back the old bytes of every file of an unfinished save. Return whether this was
    possible.
    """
    with suppress(OSError), _alone(save) as alone:
        if alone:
            bring_back(save)
            return True
    return False


def keep(target: Path, old: Path, traits: int | Traits) -> None:
    """Keep the bytes of a file under another name. If possible it is a link, which needs no
    space.
    """
    try:
        os.link(target, old)
    except OSError:
        write_new(old, target.read_bytes(), traits)


def end(save: PendingSave) -> None:
    """End a save after its new bytes are in place. The disk must have them before the record is
    removed.

    A leftover that cannot be removed now is harmless, and is removed with the next save.
    """
    settle(save.folders)
    with suppress(OSError):
        _stop_counting(save)


def bring_back(save: PendingSave) -> None:
    """Undo a save in which one part could not replace its file.

    The new bytes count until the record says otherwise, so they must stay available. First they are
    put beside the file again, and then the old bytes get their place back. OSError if that is not
    possible.
    """
    for file in save.files:
        if file.part.exists() or not file.holds(file.after):
            continue
        if file.before is None:
            file.target.replace(file.part)
        else:
            keep(file.target, file.part, 0o600)
            file.old.replace(file.target)
    settle(save.folders)
    _stop_counting(save)


def clear(draft: PendingSave) -> None:
    """Remove what a save that does not count wrote beside its files, and its record last."""
    for file in draft.files:
        for path in (file.part, file.old):
            with suppress(OSError):
                path.unlink(missing_ok=True)
    with suppress(OSError):
        draft.record.unlink()


def clear_up(folder: Path) -> None:
    """Remove the leftovers of saves that do not count in a folder (a real path).

    Only files in this user's records, and old ``.part`` files of the user, are removed. A save that
    is being made is left alone.
    """
    for draft in pending_saves(DRAFT):
        if folder in draft.folders:
            with _alone(draft) as alone:
                if alone:
                    clear(draft)
    with suppress(OSError):
        _clear_old(folder, _OF_ONE)
    with suppress(OSError):
        _clear_old(saving_folder(), _RECORD)


@contextmanager
def _alone(save: PendingSave) -> Iterator[bool]:
    """Lock the folders of a save. The value is False if its process lives, or if it has ended.

    A folder that does not exist any more is ignored.
    """
    folders = [one for one in save.folders if one.is_dir()]
    with ExitStack() as stack:
        try:
            alone = stack.enter_context(held(folders)) and save.record.is_file()
        except OSError:
            alone = False
        yield alone


def _stop_counting(save: PendingSave) -> None:
    draft = save.renamed(DRAFT)
    save.record.replace(draft.record)
    settle([draft.record.parent])
    clear(draft)


def _take_place(file: PendingFile) -> bool:
    """Let the new bytes replace the file, unless somebody has changed it. Return whether they
    did.
    """
    if file.new_bytes() is None or not file.untouched:
        return False
    file.part.replace(file.target)
    return True


def _clear_old(folder: Path, names: re.Pattern[str]) -> None:
    """Remove the user's own files with such names that nobody can be writing any more."""
    for path in folder.iterdir():
        if not names.fullmatch(path.name):
            continue
        found = path.lstat()
        old = time.time() - found.st_mtime > _LONG_AGO
        if old and stat.S_ISREG(found.st_mode) and is_own(found):
            path.unlink()
