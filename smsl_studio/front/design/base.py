"""The blueprint as it was generated last: the base with which changes by hand are merged."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import StudioError
from smsl_studio.front.chain_files import base_name
from smsl_studio.front.former_files import former_folders
from smsl_studio.generate.text.prompts import FILES, PSM

MOST_READ = 20
"""So many files are read at most."""


def generation_of(blueprint: Blueprint, path: Path) -> Blueprint | None:
    """Return the blueprint of the file ``path`` as it was generated last; None if it is not there.

    It stands in ``psm.json`` beside it, or in that of a former generation. Another blueprint of the
    same folder may have written those, so only one with the same ``_origin`` counts.
    """
    from smsl_studio.front.inputs import read

    origin = blueprint.fields.get("_origin")
    if not origin:
        return None
    for number, place in enumerate(_places(path.absolute())):
        if number >= MOST_READ:
            break
        try:
            found = read(place) if place.is_file() else None
        except (StudioError, OSError):
            continue
        if found is not None and found.fields.get("_origin") == origin:
            return found
    return None


def _places(path: Path) -> Iterator[Path]:
    folder, name = path.parent, FILES[PSM]
    folders = (folder, *former_folders(folder))
    if path.name == name:
        yield from (one / base_name(name) for one in folders)
        return
    yield from (one / name for one in folders)
