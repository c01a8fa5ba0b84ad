"""Files that something new would replace: they go to a folder of their own first."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from pathlib import Path

from smsl_studio.errors import SaveError

FORMER = "former"
MOST_FORMER = 1_000


def is_same(path: Path, raw: bytes) -> bool:
    """Return whether an ordinary file has these bytes."""
    return path.is_file() and path.stat().st_size == len(raw) and path.read_bytes() == raw


def is_there(path: Path) -> bool:
    """Return whether a file or a link is at this place. Other things are not replaced at all."""
    return path.is_symlink() or path.is_file()


def former_folders(folder: Path) -> Iterator[Path]:
    """Yield the folders with former files in ``folder``, the newest first."""
    found = []
    for number in range(1, MOST_FORMER):
        place = folder / f"{FORMER}-{number}"
        if not os.path.lexists(place):
            break
        found.append(place)
    yield from reversed(found)


def lay_aside(paths: Iterable[Path], folder: Path) -> Path | None:
    """Move files of ``folder`` into ``former-1`` there, or the next number that is free. Return it,
    None if there is nothing to move.

    A link is moved itself, and what it leads to stays as it is. SaveError if no number is free,
    OSError if a file cannot be moved.
    """
    every = list(paths)
    if not every:
        return None
    names = (folder / f"{FORMER}-{number}" for number in range(1, MOST_FORMER))
    aside = next((one for one in names if not os.path.lexists(one)), None)
    if aside is None:
        raise SaveError(
            f"{folder} has {MOST_FORMER - 1} folders of former files",
            advice=f"Move the folders {FORMER}-1 and further away.",
        )
    for path in every:
        place = aside / path.relative_to(folder)
        place.parent.mkdir(parents=True, exist_ok=True)
        if path.is_symlink():
            # A link that is written from its own folder would lead elsewhere from the new one.
            place.symlink_to(os.path.join(path.parent.absolute(), path.readlink()))  # noqa: PTH118
            path.unlink()
        else:
            path.replace(place)
    return aside
