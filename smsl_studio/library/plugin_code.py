"""Computes one digest of the code of each plugin, so that an approval can sign it."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from importlib import metadata
from pathlib import Path

from smsl_studio.errors import PluginError
from smsl_studio.library.sources import read_sources
from smsl_studio.library.survey import FoundPlugin, survey

CHANGED = "its code is not the code that was signed"


def code_at(locations: Sequence[str], extra: Sequence[Path] = ()) -> dict[str, str]:
    """Return the SHA-256 of the code of the plugins at some locations, by location.

    PluginError if the code of a plugin cannot be read.
    """
    wanted = set(locations)
    return {one.location: code_of(one) for one in survey(extra) if one.location in wanted}


def code_of(found: FoundPlugin) -> str:
    """Return the SHA-256 of a plugin's files. PluginError if they cannot be read."""
    if found.point is not None:
        return _package_code(found.point)
    return (found.sources or read_sources(Path(found.location))).digest


def _package_code(point: metadata.EntryPoint) -> str:
    """Return the SHA-256 of all files of an installed package."""
    files = (point.dist.files or []) if point.dist else []
    if point.dist is None or not files:
        raise PluginError(f"the package of the plugin {point.name!r} does not list its files")
    whole = hashlib.sha256()
    for file in sorted(files, key=str):
        if "__pycache__" in file.parts or file.suffix == ".pyc":
            continue
        try:
            raw = Path(str(point.dist.locate_file(file))).read_bytes()
        except OSError as error:
            raise PluginError(f"{file} cannot be read: {error.strerror or error}") from None
        name = str(file).encode()
        whole.update(b"%d %b %d " % (len(name), name, len(raw)) + raw)
    return whole.hexdigest()
