"""Saves of several files that a process has left behind: brought to their end, or undone."""

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
"""The ending of a record that is being written."""

_OF_ONE = re.compile(r"\..+\.(?:json|smsl|ya?ml)\.[0-9a-f]{12}\.part", re.DOTALL | re.IGNORECASE)
_RECORD = re.compile(rf"[0-9a-f]{{12}}\{FRESH}")
_LONG_AGO = 3600.0
"""Seconds without a change after which a left file is taken away."""


def interrupted_saves(files: Iterable[str | os.PathLike[str]]) -> tuple[PendingSave, ...]:
    """The saves that a process has left behind, and whose new bytes count for one of these files
    without having taken their place.
    """
    wanted = {Path(os.path.realpath(file)) for file in files}
    found = []
    for save in pending_saves():
        if any(one.target in wanted and pending_at(one.target) for one in save.files):
            with _alone(save) as alone:
                found += [save] * alone
    return tuple(found)


def finish_saves(folder: str | os.PathLike[str]) -> tuple[Path, ...]:
    """Bring to their end all saves of this user with files in a folder, and clear it up.

    The answer is the files that were replaced.
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
    """Let the new bytes of a save take their places; which files were replaced.

    What somebody else has written since stays. A save that a living process is making is left
    alone.
    """
    finished: list[Path] = []
    with suppress(OSError), _alone(save) as alone:
        if alone:
            finished.extend(file.target for file in save.files if _take_place(file))
            end(save)
    return tuple(finished)


def undo(save: PendingSave) -> bool:
    """Give every file of a save that was left behind its former bytes; whether that went well."""
    with suppress(OSError), _alone(save) as alone:
        if alone:
            bring_back(save)
            return True
    return False


def keep(target: Path, old: Path, traits: int | Traits) -> None:
    """Keep what stands in a file under another name, without room where the disk can do that."""
    try:
        os.link(target, old)
    except OSError:
        write_new(old, target.read_bytes(), traits)


def end(save: PendingSave) -> None:
    """The new bytes have taken their places: first the disk has to know, then the record goes.

    What cannot be taken away now says nothing wrong, and goes with the next save.
    """
    settle(save.folders)
    with suppress(OSError):
        _stop_counting(save)


def bring_back(save: PendingSave) -> None:
    """Undo a save of which one part could not take its place.

    The new bytes count until the record says otherwise, so each stays reachable until then: first
    they stand beside the file again, then what stood there before has its place again. OSError
    where that cannot be done.
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
    """Take away what a save that does not count wrote beside its files, its record last."""
    for file in draft.files:
        for path in (file.part, file.old):
            with suppress(OSError):
                path.unlink(missing_ok=True)
    with suppress(OSError):
        draft.record.unlink()


def clear_up(folder: Path) -> None:
    """Take away what saves that do not count have left in a folder (by its real path).

    Of all that stands there only what this user's records name, and old ``.part`` files of the
    user's own; a save that is being made is left alone.
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
    """Hold the folders of a save; False where its process lives, or it has ended.

    Who took a whole folder away took its files out of the save.
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
    """Whether the new bytes took their place; they give way to what somebody has written since."""
    if file.new_bytes() is None or not file.untouched:
        return False
    file.part.replace(file.target)
    return True


def _clear_old(folder: Path, names: re.Pattern[str]) -> None:
    """Take away the user's own files of such names in which nobody can be writing any more."""
    for path in folder.iterdir():
        if not names.fullmatch(path.name):
            continue
        found = path.lstat()
        old = time.time() - found.st_mtime > _LONG_AGO
        if old and stat.S_ISREG(found.st_mode) and is_own(found):
            path.unlink()
