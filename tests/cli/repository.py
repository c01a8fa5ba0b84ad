"""A repository of git after ``git-setup``, with the program of this environment as its driver."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

from smsl_studio.front.git_drivers import DRIVERS, git_setup


class Repository:
    """A repository after ``git-setup``, with a program of this environment as the driver."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.git("init", "-q", "-b", "main")
        git_setup(folder)
        for key, command in DRIVERS.items():
            here = command.replace("smsl-studio", f'"{sys.executable}" -m smsl_studio')
            self.git("config", key, here)

    def git(self, *arguments: str, status: int = 0) -> str:
        """Call git and return what it prints. It must end with this status."""
        done = self._call(*arguments)
        assert done.returncode == status, done.stderr
        return done.stdout

    def told(self, *arguments: str, status: int = 0) -> str:
        """Call git and return what it and its drivers print. It must end with this status."""
        done = self._call(*arguments)
        assert done.returncode == status, done.stderr
        return done.stdout + done.stderr

    def attempt(self, *arguments: str) -> int:
        """Call git and return its exit status."""
        return self._call(*arguments).returncode

    def _call(self, *arguments: str) -> subprocess.CompletedProcess[str]:
        kept = {k: v for k, v in os.environ.items() if not k.startswith("GIT_")}
        who = {f"GIT_{w}_{k}": "person" for w in ("AUTHOR", "COMMITTER") for k in ("NAME", "EMAIL")}
        nowhere = {"GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_NOSYSTEM": "1", "GIT_PAGER": "cat"}
        return subprocess.run(
            ["git", *arguments], cwd=self.folder, env=kept | who | nowhere,
            capture_output=True, text=True, check=False, timeout=60,
        )  # fmt: skip
