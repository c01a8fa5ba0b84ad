"""The files that a file may import: those of its own project, in a written form.

A blueprint may come from anybody. So an import is opened only if that can do no harm: it must be an
ordinary file below one folder, with the suffix of a written form. Links are resolved first.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import PurePath

from smsl_studio.smsl.forms import SUFFIXES

MARKS = (".git", "smsl.toml")
"""The names that mark the top folder of a project."""

LONGEST = 4096
"""The largest number of characters of a name."""

_DRIVE = re.compile(r"[A-Za-z]:")


@dataclass(frozen=True, slots=True)
class RefusedName:
    """Why a name is not followed, with an advice."""

    sentence: str
    advice: str


def real_path(file: str) -> str:
    """Return the real path of a file, by which two names can be compared. The name itself if there
    is none.
    """
    try:
        return os.path.realpath(file)
    except (OSError, ValueError):
        return file


def project_of(file: str) -> str:
    """Return the real path of the folder that must contain the imports of a file.

    It is the nearest folder with ``.git`` or ``smsl.toml``, from the file's own folder upwards, or
    else the file's own folder. Standard input counts as a file in the current folder.
    """
    own = folder = real_path(os.path.dirname(file))  # noqa: PTH120
    while True:
        if any(os.path.lexists(os.path.join(folder, mark)) for mark in MARKS):  # noqa: PTH118
            return folder
        above = os.path.dirname(folder)  # noqa: PTH120
        if above == folder:
            return own
        folder = above


def refusal_of_name(name: str) -> RefusedName | None:
    """Return why a name cannot be an import, whatever file it names. None if it can."""
    if len(name) > LONGEST or "\0" in name:
        return RefusedName("the import is no name of a file", "Name a file beside this one.")
    if name.startswith("/") or "\\" in name or _DRIVE.match(name):
        return RefusedName(
            "the import is not named from the folder of this file",
            "Write the way from here, with / between folders.",
        )
    if PurePath(name).suffix.lower() not in SUFFIXES:
        endings = ", ".join(SUFFIXES)
        return RefusedName("the import has no suffix of a blueprint", f"It ends with {endings}.")
    return None


def refusal_of_place(
    real: str, project: str, what: str = "the import", suffixes: Iterable[str] = SUFFIXES
) -> RefusedName | None:
    """Return why a file (by its real path) must not be read for a project. None if it may."""
    if not is_below(real, project):
        return RefusedName(
            f"{what} leads out of the project",
            f"Keep it below {project}, or put a file smsl.toml into the folder that holds both.",
        )
    if PurePath(real).suffix.lower() not in suffixes:
        return RefusedName(
            f"{what} leads to a file of another kind", f"It ends with {', '.join(suffixes)}."
        )
    return None


def is_below(real: str, folder: str) -> bool:
    """Return whether a real path is below the real path of a folder."""
    real, folder = os.path.normcase(real), os.path.normcase(folder)
    return real.startswith(os.path.join(folder, ""))  # noqa: PTH118
