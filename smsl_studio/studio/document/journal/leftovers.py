"""Journals of windows that ended without closing."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from smsl_studio.errors import ReadError
from smsl_studio.home import is_own
from smsl_studio.studio.document.journal.entry import JournalEntry, decode
from smsl_studio.studio.document.journal.place import LOCK, SUFFIX, JournalFile

MOST = 50
"""The most journals that one start offers; others are offered at the next start."""


@dataclass(frozen=True)
class Left:
    """A journal of a window that is gone. It is locked until ``drop`` or ``keep``."""

    entry: JournalEntry
    place: JournalFile

    def drop(self) -> None:
        """Delete it: it was recovered or is not wanted."""
        self.place.remove()
        self.place.let_go()

    def keep(self) -> None:
        """Release it, so that the next start offers it again."""
        self.place.let_go()


def left_behind(folder: Path) -> tuple[Left, ...]:
    """The journals that no running window holds, the newest first.

    A journal that cannot be read gets another suffix. It is then out of the way, but not lost.
    """
    found = sorted(_left(folder), key=lambda left: left.entry.when, reverse=True)
    for beyond in found[MOST:]:
        beyond.keep()
    return tuple(found[:MOST])


def _left(folder: Path) -> Iterator[Left]:
    try:
        paths = sorted(folder.iterdir())
    except OSError:
        return
    for path in paths:
        if path.suffix == SUFFIX:
            left = _claimed(path)
            if left is not None:
                yield left
        elif path.suffix == LOCK and not path.with_suffix(SUFFIX).exists():
            _sweep(path.with_suffix(SUFFIX))


def _claimed(path: Path) -> Left | None:
    try:
        if not is_own(path.lstat()):
            return None
        place = JournalFile.claim(path)
    except OSError:
        return None
    if place is None:
        return None
    try:
        return Left(decode(place.read()), place)
    except FileNotFoundError:
        pass
    except OSError:
        place.let_go()
        return None
    except ReadError:
        path.replace(path.with_suffix(".unreadable"))
    place.let_go()
    return None


def _sweep(path: Path) -> None:
    """Delete the lock of a window that left no journal."""
    try:
        place = JournalFile.claim(path)
    except OSError:
        return
    if place is not None:
        place.remove()
        place.let_go()
