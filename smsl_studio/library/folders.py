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
        return Path(given).expanduser()
    if sys.platform == "darwin":
        return Path.home() / "Library" / "Application Support" / "smsl-studio"
    if sys.platform == "win32":
        return Path(os.environ.get("APPDATA") or Path.home()) / "smsl-studio"
    return Path(os.environ.get("XDG_CONFIG_HOME") or Path.home() / ".config") / "smsl-studio"


def plugin_path() -> tuple[Path, ...]:
    """The folders in ``SMSL_PLUGIN_PATH``, in order."""
    parts = os.environ.get("SMSL_PLUGIN_PATH", "").split(os.pathsep)
    return tuple(Path(part).expanduser() for part in parts if part)
