"""The content of a plugin's folder: its permissions, its digest, and its code.

The code of an allowed plugin is imported from these bytes and not from the disk, so exactly the
digested code runs. The digest also covers files that a plugin reads by itself. Such a file may
still change between the digest and the moment when the plugin reads it.
"""

from __future__ import annotations

import hashlib
import os
import stat
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from importlib.machinery import EXTENSION_SUFFIXES
from pathlib import Path

from smsl_studio.errors import PluginError
from smsl_studio.library.ownership import exposure_of, exposure_on_the_way

MOST_FILES = 20_000
MOST_BYTES = 100_000_000
"""The largest number of files and bytes in a plugin's folder, so that a digest stays quick."""

APART = ("__pycache__", ".git")
"""Folders that are left out of the digest. Their files are never imported."""

_CODE = (".py", *EXTENSION_SUFFIXES)


@dataclass(frozen=True, slots=True)
class Sources:
    """A plugin's folder at one moment.

    ``modules`` maps each Python file (its path below the folder, with ``/``) to its bytes,
    ``compiled`` each extension module to the digest of its bytes.
    """

    folder: Path
    digest: str
    modules: Mapping[str, bytes]
    compiled: Mapping[str, str]


@dataclass(frozen=True, slots=True)
class PackageSources(Sources):
    """The modules of an installed package at one moment.

    ``folder`` is the folder in which they lie, ``names`` are its modules of the highest level. If
    it is ``closed``, no other module of ``folder`` is imported beside them: the package does not
    list its modules, so what else lies there may belong to it.
    """

    names: frozenset[str]
    closed: bool


def check_sources(folder: Path) -> None:
    """Raise PluginError if another user could change the content of a plugin's folder.

    Links that lead out of the folder are followed, and their targets are checked, too.
    """
    waiting, seen = [folder], {folder}
    while waiting:
        for path, found in _entries(waiting.pop()):
            if not stat.S_ISLNK(found.st_mode):
                continue
            try:
                there = path.resolve(strict=True)
                exposed = exposure_on_the_way(path)
            except (OSError, RuntimeError):  # the link leads nowhere, or in a circle
                continue
            if exposed is not None:
                raise exposed.error(folder)
            if there not in seen and not there.is_relative_to(folder):
                seen.add(there)
                waiting.append(there)


def read_sources(folder: Path) -> Sources:
    """Read the digest and the code of a plugin's folder.

    PluginError if another user could change the folder, if a link leads out of it, if an entry is
    no ordinary file, or if there is more than ``MOST_FILES`` or ``MOST_BYTES``.
    """
    whole, left = hashlib.sha256(), MOST_BYTES
    modules: dict[str, bytes] = {}
    compiled: dict[str, str] = {}
    for path, found in _entries(folder, APART):
        name = path.relative_to(folder).as_posix()
        if stat.S_ISDIR(found.st_mode):
            continue
        if stat.S_ISLNK(found.st_mode):
            add_line(whole.update, "link", name, os.fsencode(path.readlink()))
            if not _stays(path, folder):
                raise PluginError(
                    f"{name} is a link that leads out of its folder",
                    advice="Put the file itself in the place of the link.",
                )
            if not path.is_file():
                continue
        elif not stat.S_ISREG(found.st_mode):
            raise _no_file(name)
        raw = content_at(path, name, left)
        left -= len(raw)
        digest = hashlib.sha256(raw).digest()
        add_line(whole.update, "file", name, digest)
        if name.endswith(".py"):
            modules[name] = raw
        elif name.endswith(_CODE):
            compiled[name] = digest.hex()
    return Sources(folder, whole.hexdigest(), modules, compiled)


def _entries(folder: Path, apart: tuple[str, ...] = ()) -> Iterator[tuple[Path, os.stat_result]]:
    """Yield the folder and all its entries in the order of their names, with the result of
    ``lstat``. No link is followed.

    PluginError if another user could change an entry, or if there are too many entries.
    """
    waiting, count = [folder], 0
    while waiting:
        path = waiting.pop()
        count += 1
        if count > MOST_FILES:
            raise PluginError(
                f"its folder holds more than {MOST_FILES} files",
                advice="Keep in it only what the plugin needs.",
            )
        try:
            found = path.lstat()
            folders = stat.S_ISDIR(found.st_mode)
            inner = sorted(os.listdir(path), reverse=True) if folders else []  # noqa: PTH208
        except OSError as error:
            raise PluginError(f"{path} cannot be read: {error.strerror or error}") from None
        exposed = exposure_of(path, found)
        if exposed is not None:
            raise exposed.error(folder)
        yield path, found
        waiting += [path / name for name in inner if name not in apart]


def _stays(link: Path, folder: Path) -> bool:
    """Whether a link leads to an entry of the folder."""
    try:
        return link.resolve(strict=True).is_relative_to(folder)
    except (OSError, RuntimeError):  # the link leads nowhere, or in a circle
        return False


def content_at(path: Path, name: str, most: int) -> bytes:
    """Return the bytes of an ordinary file. PluginError for any other file, or more than ``most``
    bytes."""
    flags = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)
    try:
        handle = os.open(path, flags)
        with os.fdopen(handle, "rb") as file:
            if not stat.S_ISREG(os.fstat(handle).st_mode):
                raise _no_file(name)
            raw = file.read(most + 1)
    except OSError as error:
        raise PluginError(f"{name} cannot be read: {error.strerror or error}") from None
    if len(raw) > most:
        raise PluginError(
            f"its folder holds more than {MOST_BYTES // 1_000_000} MB",
            advice="Keep large files in a folder of their own.",
        )
    return raw


def _no_file(name: str) -> PluginError:
    return PluginError(f"{name} is no ordinary file", advice="Take it out of the folder.")


def add_line(whole: Callable[[bytes], object], kind: str, name: str, value: bytes) -> None:
    """Add one entry to a digest. The lengths separate names from values."""
    for part in (kind.encode(), os.fsencode(name), value):
        whole(len(part).to_bytes(8, "big") + part)
