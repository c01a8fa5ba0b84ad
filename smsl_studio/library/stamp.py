"""The stamp of library code: a value that changes when a plugin is edited."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from itertools import islice
from pathlib import Path

from smsl_studio.home import user_folder
from smsl_studio.library.decisions import decisions_file
from smsl_studio.library.folders import plugin_path
from smsl_studio.shipped import plugins_dir

MOST = 5000
"""The largest number of files in a stamp, so that it stays quick."""

_SKIPPED = ("__pycache__", ".git")


def library_stamp(extra: Sequence[Path] = (), beside: str = "") -> tuple[object, ...]:
    """Return name, time and size of every file in the plugin folders, of the user's decisions, and
    of the bindings file beside the blueprint file ``beside``.

    ``extra`` are further plugin folders. Installed packages are left out, because a change of them
    counts only when Python is started anew.
    """
    folders = [*extra, *plugin_path(), user_folder() / "plugins", plugins_dir()]
    files = [decisions_file()]
    files += [Path(beside).with_suffix(".toml")] if Path(beside).suffix else []
    files += islice((file for folder in folders for file in _files(folder)), MOST)
    return (str(Path.cwd()), tuple(map(str, folders)), *(_looked(file) for file in files))


def _files(folder: Path) -> Iterator[Path]:
    for place, inner, names in os.walk(folder):
        inner[:] = sorted(name for name in inner if name not in _SKIPPED)
        yield from (Path(place) / name for name in sorted(names))


def _looked(file: Path) -> tuple[str, int, int]:
    try:
        seen = file.stat()
    except (OSError, ValueError):
        return str(file), 0, -1
    return str(file), seen.st_mtime_ns, seen.st_size
