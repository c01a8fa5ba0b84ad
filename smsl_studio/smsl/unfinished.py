"""Saves that a process has left behind: brought to their end, or cleared away."""

from __future__ import annotations

import json
import os
import re
import time
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path

from smsl_studio.smsl.disk import held, settle, write_new
from smsl_studio.smsl.pending import (
    MARKER,
    Marker,
    journal_in,
    marker_of,
    small_json,
    token_of,
)

_OF_SEVERAL = re.compile(r"\..+\.(?P<token>[0-9a-f]{12})-\d{1,6}\.(?:part|old)", re.DOTALL)
_OF_ONE = re.compile(r"\..+\.(?:json|smsl|ya?ml)\.[0-9a-f]{12}\.part", re.DOTALL | re.IGNORECASE)
_LONG_AGO = 3600.0
"""Seconds."""


def finish_saves(folder: str | os.PathLike[str]) -> tuple[Path, ...]:
    """Bring to its end what an earlier save of several files has left in a folder.

    Where its new bytes count they take their places, and these files are the answer; anything
    else it left goes. A save that a living process is making is left alone.
    """
    finished: list[Path] = []
    with suppress(OSError, ValueError):
        place = Path(os.path.realpath(folder))
        for journal in _journals(place):
            finished.extend(_finish(journal))
        _clear_folder(place)
    return tuple(finished)


def listing(journal: Path, markers: Iterable[Marker]) -> bytes:
    """What a journal says: the files of its save."""
    return json.dumps([os.path.relpath(one.target, journal.parent) for one in markers]).encode()


def keep(target: Path, old: Path, mode: int) -> None:
    """Keep what stands in a file under another name, without room where the disk can do that."""
    try:
        os.link(target, old)
    except OSError:
        write_new(old, target.read_bytes(), mode)


def end(journal: Path, markers: list[Marker]) -> None:
    """The parts have taken their places: first the disk has to know, then the journal goes.

    What cannot be taken away now says nothing wrong, and goes with the next save.
    """
    settle({marker.target.parent for marker in markers})
    with suppress(OSError):
        journal.unlink()
        settle([journal.parent])
        clear(markers)


def clear(markers: Iterable[Marker]) -> None:
    """Take away what a save wrote beside its files, the markers last."""
    for marker in markers:
        for path in (marker.part, marker.old, marker.path):
            with suppress(OSError):
                path.unlink()


def bring_back(journal: Path, markers: list[Marker]) -> None:
    """Undo a save of which one part could not take its place.

    The new bytes count until the journal goes, so each stays reachable until then: first they
    have their ``.part`` again, then what stood there before has its place again.
    """
    for marker in markers:
        if marker.part.exists():
            continue
        if marker.before is None:
            marker.target.replace(marker.part)
        else:
            keep(marker.target, marker.part, 0o600)
            marker.old.replace(marker.target)
    settle({marker.target.parent for marker in markers})
    journal.unlink()
    clear(markers)


def _journals(folder: Path) -> set[Path]:
    """The journals that stand in a folder, or are named by a marker in it."""
    named = {path if token_of(path) else journal_in(path) for path in folder.iterdir()}
    return {journal for journal in named if journal is not None and journal.is_file()}


def _finish(journal: Path) -> list[Path]:
    """Let the parts of a save that counts take their places."""
    # Who took a whole folder away took its files out of the save.
    targets = [target for target in _listed(journal) if target.parent.is_dir()]
    with suppress(OSError), held({journal.parent, *(one.parent for one in targets)}) as alone:
        if not alone or not journal.is_file():
            return []
        found = [marker for marker in map(marker_of, targets) if marker is not None]
        markers = [marker for marker in found if marker.journal == journal]
        finished = [marker.target for marker in markers if _take_place(marker)]
        end(journal, markers)
        return finished
    return []


def _listed(journal: Path) -> list[Path]:
    written = small_json(journal)
    names = written if isinstance(written, list) else []
    found = (os.path.join(journal.parent, name) for name in names if isinstance(name, str))  # noqa: PTH118
    return [Path(os.path.normpath(name)) for name in found if "\0" not in name]


def _take_place(marker: Marker) -> bool:
    """Whether a part took its place; it gives way to what somebody else has written since."""
    if not marker.part.is_file() or not marker.untouched:
        return False
    marker.part.replace(marker.target)
    return True


def _clear_folder(folder: Path) -> None:
    """Take away what belongs to no save that counts, unless a save is being made here."""
    with held([folder]) as alone:
        if not alone:
            return
        counting = {token_of(journal) for journal in _journals(folder)}
        for path in list(folder.iterdir()):
            if _is_left(path, counting):
                path.unlink()


def _is_left(path: Path, counting: set[str]) -> bool:
    """Whether a file is what a save that ended too early has left; ``counting`` are the tokens of
    those that are still to be finished.
    """
    name = path.name
    if name.startswith(".") and name.endswith(MARKER):
        journal = journal_in(path)
        return journal is None or not journal.is_file()
    if several := _OF_SEVERAL.fullmatch(name):
        return several["token"] not in counting
    # A save of one file holds no folder: what is old cannot be at work any more.
    return bool(_OF_ONE.fullmatch(name)) and time.time() - path.stat().st_mtime > _LONG_AGO
