"""Saves of several files that have begun and not ended: which bytes of a file count.

Beside each file stands its marker, which names the journal of the save; the journal stands from
the moment at which all the new texts count until all have taken their places. A journal that
stands: the new bytes. None: what stands in the file. Nothing here writes.
"""

from __future__ import annotations

import json
import os
import re
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from smsl_studio.smsl.disk import short

JOURNAL = re.compile(r"\.smsl-studio\.(?P<token>[0-9a-f]{12})\.journal")
MARKER = ".smsl-studio-saving"
_LARGEST = 1 << 22


@dataclass(frozen=True)
class Marker:
    """The part that one file has in a save; ``before`` is the digest of what stood there."""

    target: Path
    journal: Path
    index: int
    before: str | None

    @property
    def token(self) -> str:
        """What the journal and the files of one save have in their names."""
        return token_of(self.journal)

    @property
    def path(self) -> Path:
        return marker_path(self.target)

    @property
    def part(self) -> Path:
        """The new bytes, as long as they have not taken their place."""
        return self._beside("part")

    @property
    def old(self) -> Path:
        """What stood there before, as long as it might have to come back."""
        return self._beside("old")

    @property
    def committed(self) -> bool:
        return self.journal.is_file()

    @property
    def untouched(self) -> bool:
        """Whether the file is still the one that stood there before the save."""
        return digest_at(self.target) == self.before

    def encoded(self) -> bytes:
        journal = os.path.relpath(self.journal, self.target.parent)
        return json.dumps([journal, self.index, self.before]).encode()

    def _beside(self, ending: str) -> Path:
        name = f".{short(self.target.name)}.{self.token}-{self.index}.{ending}"
        return self.target.with_name(name)


def marker_path(target: Path) -> Path:
    return target.with_name(f".{short(target.name)}{MARKER}")


def journal_path(folder: Path, token: str) -> Path:
    return folder / f".smsl-studio.{token}.journal"


def token_of(journal: Path) -> str:
    """The token in the name of a journal, the empty text where it is the name of none."""
    named = JOURNAL.fullmatch(journal.name)
    return named["token"] if named else ""


def digest_at(target: Path) -> str | None:
    """The digest of a file's bytes, None where there is no file."""
    import hashlib  # needed only where a save is being made, and slow to load

    try:
        return hashlib.sha256(target.read_bytes()).hexdigest()
    except OSError:
        return None


def marker_of(target: Path) -> Marker | None:
    """The marker beside a file (by its real path), None where there is none that makes sense."""
    path = marker_path(target)
    written = _marker_at(path)
    if written is None:
        return None
    journal, index, before = written
    return Marker(target, journal, index, before)


def journal_in(path: Path) -> Path | None:
    """The journal that a marker names, None where the file is no marker."""
    written = _marker_at(path) if path.name.endswith(MARKER) else None
    return written[0] if written else None


def _marker_at(path: Path) -> tuple[Path, int, str | None] | None:
    written = small_json(path) if os.path.lexists(path) else None
    if not isinstance(written, list) or len(written) != 3:
        return None
    name, index, before = written
    if not isinstance(name, str) or type(index) is not int or not 0 <= index < 10**6:
        return None
    journal = Path(os.path.normpath(path.parent / name))
    return (
        (journal, index, before if isinstance(before, str) else None) if token_of(journal) else None
    )


def small_json(path: Path) -> Any:
    """The JSON in a small ordinary file, None where there is none."""
    with suppress(OSError, ValueError, RecursionError):
        if path.is_file() and path.stat().st_size <= _LARGEST:
            return json.loads(path.read_bytes())
    return None


def standing(target: Path) -> Path:
    """The file whose bytes are those of ``target`` (a real path) now."""
    marker = marker_of(target) if target.name else None
    if marker is None or not marker.committed or not marker.part.is_file():
        return target
    return marker.part if marker.untouched else target
