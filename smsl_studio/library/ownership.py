"""Ownership: checks whether another user could change a file or folder.

Code and decisions are trusted only if no user except this one and root can change them. On systems
without such permissions (Windows) nothing is checked.
"""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from smsl_studio.errors import PluginError

try:
    import grp
    import pwd
except ImportError:  # Windows
    pass

ROOT = 0
_MOST_LINKS = 40


@dataclass(frozen=True, slots=True)
class Exposure:
    """A path that another user could change, with the reason and an advice."""

    path: Path
    words: str
    advice: str

    def error(self, subject: Path) -> PluginError:
        """Return the error for ``subject``, which is this path or lies below it."""
        what = "it" if self.path == subject else str(self.path)
        return PluginError(f"{what} {self.words}", advice=self.advice)


def exposure_of(path: Path, found: os.stat_result, *, passed: bool = False) -> Exposure | None:
    """Say how another user could change the entry at ``path``, or return None.

    ``found`` is the result of ``lstat`` for the path. ``passed`` is for a folder that a path only
    goes through. There a sticky bit is enough, because then only an entry's owner can replace it.
    """
    if os.name != "posix":
        return None
    if found.st_uid not in (os.geteuid(), ROOT):
        return Exposure(
            path,
            f"belongs to the user {_user(found.st_uid)}, who can change it at any time",
            "Look at what is in it, and copy it to a folder of your own.",
        )
    if stat.S_ISLNK(found.st_mode):
        return None  # only its owner can replace it
    others = bool(found.st_mode & stat.S_IWOTH)
    group = bool(found.st_mode & stat.S_IWGRP) and not _is_own_group(path, found.st_gid)
    sticky = passed and stat.S_ISDIR(found.st_mode) and bool(found.st_mode & stat.S_ISVTX)
    if not (others or group) or sticky:
        return None
    who = "everybody" if others else f"the group {_group(found.st_gid)}"
    return Exposure(
        path,
        f"may be written by {who} ({stat.filemode(found.st_mode)})",
        f"Look at what is in it, then: chmod {'go-w' if others else 'g-w'} {path}",
    )


def exposure_on_the_way(path: Path) -> Exposure | None:
    """Return the first folder or link on the way to ``path`` that another user could change.

    The entry at ``path`` itself counts as passed, too. OSError if there is no such entry.
    """
    if os.name != "posix":
        return None
    found = (exposure_of(one, one.lstat(), passed=True) for one in _way(path))
    return next(filter(None, found), None)


def _way(path: Path) -> Iterator[Path]:
    """Yield every folder and every link on the way to a path, the root first. A link is yielded
    itself before the folders that it leads through."""
    left = list(reversed((Path.cwd() / path).parts))
    here, links = Path(left.pop()), 0
    yield here
    while left:
        part = left.pop()
        if part == "..":
            here = here.parent
            continue
        there = here / part
        yield there
        if not there.is_symlink():
            here = there
            continue
        links += 1
        if links > _MOST_LINKS:
            raise OSError(errno.ELOOP, os.strerror(errno.ELOOP), str(path))
        target = there.readlink()
        parts = list(target.parts)
        if target.is_absolute():
            here = Path(parts.pop(0))
        left.extend(reversed(parts))


def _is_own_group(path: Path, group: int) -> bool:
    """Whether a group is the private group that many systems give to each user.

    Such a group has the user's name and no other member. Root's group never counts, because some
    processes of other users run with it. A path with an access list never counts, because the
    list may be hidden behind the permission bits of the group.
    """
    if group == ROOT or group != os.getegid():
        return False
    try:
        found, user = grp.getgrgid(group), pwd.getpwuid(os.geteuid())
        listed = "system.posix_acl_access" in os.listxattr(path)
    except (KeyError, OSError, AttributeError):
        return False
    return not listed and found.gr_name == user.pw_name and set(found.gr_mem) <= {user.pw_name}


def _user(number: int) -> str:
    try:
        return f"{pwd.getpwuid(number).pw_name} ({number})"
    except KeyError:
        return str(number)


def _group(number: int) -> str:
    try:
        return f"{grp.getgrgid(number).gr_name} ({number})"
    except KeyError:
        return str(number)
