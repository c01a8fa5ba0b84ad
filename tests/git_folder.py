"""A folder in which git knows who commits, and takes nothing else from this machine."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest


def git_folder(folder: Path, patch: pytest.MonkeyPatch) -> Callable[..., None]:
    """Calls git in a folder. What the program asks git there has the same settings."""
    for name in [name for name in os.environ if name.startswith("GIT_")]:
        patch.delenv(name)
    for who in ("AUTHOR", "COMMITTER"):
        patch.setenv(f"GIT_{who}_NAME", "Ada")
        patch.setenv(f"GIT_{who}_EMAIL", "ada@example.org")
    patch.setenv("GIT_CONFIG_GLOBAL", os.devnull)
    patch.setenv("GIT_CONFIG_NOSYSTEM", "1")
    patch.setenv("GIT_CEILING_DIRECTORIES", str(folder.parent))

    def git(*arguments: str) -> None:
        subprocess.run(["git", *arguments], cwd=folder, check=True, capture_output=True, timeout=60)

    return git
