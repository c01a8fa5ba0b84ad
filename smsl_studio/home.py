"""The user's own folder, and which files in it only the user can have written."""

from __future__ import annotations

import os
import sys
from pathlib import Path


def user_folder() -> Path:
    """The user's folder: ``SMSL_STUDIO_HOME``, else the platform's usual place.

    It need not exist; nothing is written here.
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
    """Where the records of this user's saves of several files are kept; it need not exist."""
    return user_folder().absolute() / "saving"


def expanded(text: str) -> Path:
    """A folder as written, ``~`` resolved; kept as it is for a user nobody knows."""
    return Path(os.path.expanduser(text))  # noqa: PTH111 -- that of Path raises


def is_own(found: os.stat_result) -> bool:
    """Whether a file or folder belongs to who runs this program; on Windows that is not known."""
    return sys.platform == "win32" or found.st_uid == os.geteuid()


def is_private(found: os.stat_result) -> bool:
    """Whether it is the user's own, and nobody else may write it.

    Always true on Windows, where a user's folder is shut to others by the system.
    """
    return is_own(found) and (sys.platform == "win32" or not found.st_mode & 0o022)
