"""The user's own folder, and checks that only the user can have written a file."""

from __future__ import annotations

import os
import sys
from pathlib import Path


def user_folder() -> Path:
    """Return the user's folder: ``SMSL_STUDIO_HOME``, else the usual place of the platform.

    The folder need not exist. This function does not create it.
    """
    given = os.environ.get("SMSL_STUDIO_HOME")
    if given:
        return expanded(given)
    home = expanded("~")
    if sys.platform == "darwin":
        return home / "Library" / "Application Support" / "smsl-studio"
    if sys.platform == "win32":
        return Path(os.environ.get("APPDATA") or home) / "smsl-studio"
    return Path(os.environ.get("XDG_CONFIG_HOME") or home / ".config") / "smsl-studio"


def saving_folder() -> Path:
    """Return the folder with the records of this user's saves of several files. It need not
    exist."""
    return user_folder().absolute() / "saving"


def expanded(text: str) -> Path:
    """Return a folder with ``~`` resolved. ``~name`` of an unknown user does not change."""
    return Path(os.path.expanduser(text))  # noqa: PTH111 -- that of Path raises


def is_own(found: os.stat_result) -> bool:
    """Whether a file or folder belongs to the user who runs this program. On Windows it is always
    true, because the owner is not known."""
    return sys.platform == "win32" or found.st_uid == os.geteuid()


def is_private(found: os.stat_result) -> bool:
    """Whether a file or folder belongs to the user, and no other user may write it.

    On Windows it is always true, because the system protects a user's folder.
    """
    return is_own(found) and (sys.platform == "win32" or not found.st_mode & 0o022)
