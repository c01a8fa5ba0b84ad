"""The traits of a file besides its bytes: owner, group, mode, extended attributes, hard links.

A save replaces the old file by a new one. The new file gets the same traits as far as the system
lets this user set them. Nobody gets a right that they did not have before. ``losses`` tells in
advance what cannot be set.
"""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path

ACL = "system.posix_acl_access"
"""The attribute with an access control list (Linux)."""
_ENTRY, _HEAD, _GROUP_OBJ = 8, 4, 0x04
_ABSENT = (errno.ENODATA, errno.ENOTSUP, errno.EPERM, errno.EACCES, errno.ENOSYS)


@dataclass(frozen=True)
class Traits:
    """The traits of a file. ``names`` counts its hard links. ``attributes`` are the extended ones
    with their values, such as an access control list.
    """

    owner: int
    group: int
    mode: int
    names: int = 1
    attributes: Mapping[str, bytes] = field(default_factory=dict)


def traits_of(target: Path) -> Traits | None:
    """Return the traits of the file at ``target``, None if there is none.

    OSError if it is not ordinary or cannot be written, because replacing a file does not check
    this.
    """
    try:
        found = target.stat()
    except FileNotFoundError:
        return None
    if not stat.S_ISREG(found.st_mode):
        raise OSError(0, "it is no ordinary file")
    if not os.access(target, os.W_OK):
        raise PermissionError(13, "it may only be read")
    mode = stat.S_IMODE(found.st_mode)
    return Traits(found.st_uid, found.st_gid, mode, found.st_nlink, _attributes(target))


def give(file: int, traits: Traits) -> tuple[str, ...]:
    """Give an open file these traits. Return in words what could not be set.

    The file belongs to this user, and nobody else may read it yet.
    """
    lost: list[str] = []
    if not hasattr(os, "fchown"):  # on Windows owner and rights come from the folder
        return ()
    mode = traits.mode
    now = os.fstat(file)
    if now.st_gid != traits.group and not _given(file, -1, traits.group):
        lost.append(f"its group, {_group(traits.group)}")
        # The rights of one group must not go to another, and a program must not run with another
        # group.
        mode &= ~stat.S_ISGID & ~(stat.S_IRWXG & ~((mode & stat.S_IRWXO) << 3))
    if now.st_uid != traits.owner and not _given(file, traits.owner, -1):
        lost.append(f"its owner, {_user(traits.owner)}")
        mode &= ~stat.S_ISUID
    kept = _attributes(file)
    for name, value in traits.attributes.items():
        if kept.get(name) == value or _set(file, name, value):
            continue
        if name != ACL:
            lost.append(f"its attribute {name}")
            continue
        lost.append("its access control list")
        # With a list the mode shows the union of rights in it. The group itself may have fewer.
        mode &= ~stat.S_IRWXG | (_group_entry(value) << 3)
    os.fchmod(file, mode)
    return tuple(lost)


def losses(target: Path) -> tuple[str, ...]:
    """Return in words what the file at ``target`` would lose if it was replaced now. This is tried
    with an empty file beside it. OSError if none can be made there.
    """
    traits = traits_of(target)
    if traits is None:
        return ()
    with _trial(target) as file:
        lost = give(file, traits)
    if traits.names == 1:
        return lost
    others = "another name" if traits.names == 2 else f"{traits.names - 1} other names"
    return (*lost, f"{others} (hard links), which would keep the old text")


@contextmanager
def _trial(target: Path) -> Iterator[int]:
    path = target.with_name(f".{os.urandom(6).hex()}.part")
    file = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
    try:
        yield file
    finally:
        os.close(file)
        path.unlink()


def _given(file: int, owner: int, group: int) -> bool:
    try:
        os.fchown(file, owner, group)
    except OSError:
        return False
    return True


def _attributes(file: Path | int) -> dict[str, bytes]:
    """Return the extended attributes that can be read. Empty if the system has none."""
    found: dict[str, bytes] = {}
    if not hasattr(os, "listxattr"):
        return found
    try:
        names = os.listxattr(file)
    except OSError as error:
        if error.errno in _ABSENT:
            return found
        raise
    for name in names:
        with suppress(OSError):
            found[name] = os.getxattr(file, name)
    return found


def _set(file: int, name: str, value: bytes) -> bool:
    try:
        os.setxattr(file, name, value)
    except OSError:
        return False
    return True


def _group_entry(value: bytes) -> int:
    """Return the rights of the file's own group in an access control list, as three bits."""
    for at in range(_HEAD, len(value) - _ENTRY + 1, _ENTRY):
        if int.from_bytes(value[at : at + 2], "little") == _GROUP_OBJ:
            return int.from_bytes(value[at + 2 : at + 4], "little") & 0o7
    return 0


def _user(number: int) -> str:
    with suppress(ImportError, KeyError):
        import pwd

        return pwd.getpwuid(number).pw_name
    return str(number)


def _group(number: int) -> str:
    with suppress(ImportError, KeyError):
        import grp

        return grp.getgrgid(number).gr_name
    return str(number)
