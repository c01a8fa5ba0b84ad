"""Further folders of plugins, which the user names in the environment."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

from smsl_studio.home import expanded

FOLDERS, GIVEN = "SMSL_PLUGIN_PATH", "SMSL_PLUGIN_PATH_GIVEN"
"""The variable with the folders, and what it was before ``name_plugin_folders``."""


def name_plugin_folders(folders: Sequence[str]) -> None:
    """Let this process and its children also look for plugins in these folders.

    They stand behind those that the user named in the environment. The next call replaces them.
    """
    given = os.environ.get(GIVEN, os.environ.get(FOLDERS, ""))
    if folders or GIVEN in os.environ:
        os.environ[GIVEN] = given
        os.environ[FOLDERS] = os.pathsep.join(filter(None, (given, *folders)))


def plugin_path() -> tuple[Path, ...]:
    """Return the folders in ``SMSL_PLUGIN_PATH``, in order."""
    parts = os.environ.get(FOLDERS, "").split(os.pathsep)
    return tuple(expanded(part) for part in parts if part)
