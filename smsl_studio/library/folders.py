"""Further folders of plugins, which the user names in the environment."""

from __future__ import annotations

import os
from pathlib import Path

from smsl_studio.home import expanded


def plugin_path() -> tuple[Path, ...]:
    """Return the folders in ``SMSL_PLUGIN_PATH``, in order."""
    parts = os.environ.get("SMSL_PLUGIN_PATH", "").split(os.pathsep)
    return tuple(expanded(part) for part in parts if part)
