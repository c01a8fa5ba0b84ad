"""The files of the user's store. They are small JSON files.

A file is only accepted if no other user could have written it.
"""

from __future__ import annotations

import json
import os
import secrets
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from smsl_studio.errors import Place, SaveError, SealError
from smsl_studio.home import user_folder
from smsl_studio.library.ownership import exposure_of, exposure_on_the_way
from smsl_studio.seal.strict_json import read_strictly
from smsl_studio.smsl.disk import held, settle, write_new
from smsl_studio.smsl.inputs import read_ordinary

Json = Any
LARGEST = 64 << 20
PATIENCE = 5.0
"""How long to wait for another program that writes the store, in seconds of wall time."""


def store_folder() -> Path:
    """Return the folder of the store. It exists only after the first file was written."""
    return user_folder() / "store"


@contextmanager
def store_alone() -> Iterator[Path]:
    """Hold the lock of the store inside the block, and create the folder if it is missing.

    So no other program of Studio writes the store at the same time. SaveError if the folder cannot
    be written, or if the lock is not free after ``PATIENCE`` seconds.
    """
    folder = store_folder()
    try:
        for one in (folder.parent, folder):
            one.mkdir(mode=0o700, parents=True, exist_ok=True)
        with held([folder], PATIENCE) as alone:
            if not alone:
                raise SaveError(
                    f"{folder} is being written by another program", advice="Try again."
                )
            yield folder
    except OSError as error:
        raise SaveError(f"{folder} cannot be written: {error.strerror or error}") from None


def read_stored(path: Path) -> Json:
    """Return the content of a file of the store, or None if the file does not exist.

    SealError if the file cannot be read, if another user could have written it, or if it is no
    JSON.
    """
    try:
        found = path.lstat()
    except (FileNotFoundError, NotADirectoryError):
        return None
    try:
        exposed = exposure_on_the_way(path) or exposure_of(path, found)
        if exposed is not None:
            raise _not_believed(path, f"{exposed.path} {exposed.words}", exposed.advice)
        raw = read_ordinary(path, LARGEST).raw
    except OSError as error:
        raise _not_believed(path, f"it cannot be read: {error.strerror or error}") from None
    try:
        return read_strictly(raw, "it")
    except SealError as error:
        raise _not_believed(path, error.sentence) from None


def write_stored(path: Path, values: Json) -> None:
    """Replace a file of the store in one step. Only the user can read the file.

    SaveError if it cannot be written.
    """
    text = f"{json.dumps(values, indent=2)}\n"
    part = path.with_name(f".{path.name}.{secrets.token_hex(8)}.part")
    try:
        path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        try:
            write_new(part, text.encode("ascii"), 0o600)
            os.replace(part, path)  # noqa: PTH105
        finally:
            part.unlink(missing_ok=True)
    except OSError as error:
        raise SaveError(f"{path} cannot be written: {error.strerror or error}") from None
    settle([path.parent])


def _not_believed(path: Path, words: str, advice: str = "") -> SealError:
    return SealError(
        f"this file of your store is not believed: {words}",
        Place(str(path), 1, 1),
        advice or "Put back your copy of it, or take it away.",
    )
