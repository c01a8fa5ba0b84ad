"""Where the user's own things stand."""

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
        return _expanded(given)
    home = _expanded("~")
    if sys.platform == "darwin":
        return home / "Library" / "Application Support" / "smsl-studio"
    if sys.platform == "win32":
        return Path(os.environ.get("APPDATA") or home) / "smsl-studio"
    return Path(os.environ.get("XDG_CONFIG_HOME") or home / ".config") / "smsl-studio"


def plugin_path() -> tuple[Path, ...]:
    """The folders in ``SMSL_PLUGIN_PATH``, in order."""
    parts = os.environ.get("SMSL_PLUGIN_PATH", "").split(os.pathsep)
    return tuple(_expanded(part) for part in parts if part)


def _expanded(text: str) -> Path:
    """A folder as written, ``~`` resolved; kept as it is for a user nobody knows."""
    return Path(os.path.expanduser(text))  # noqa: PTH111 -- that of Path raises
