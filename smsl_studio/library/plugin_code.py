"""Computes one digest of the code of each plugin, so that an approval can sign it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from smsl_studio.library.package_sources import read_package
from smsl_studio.library.sources import Sources, read_sources
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
    return (found.sources or sources_of(found)).digest


def sources_of(found: FoundPlugin) -> Sources:
    """Read the code of a plugin as it is now. PluginError if it cannot be read."""
    if found.point is not None:
        return read_package(found.point)
    return read_sources(Path(found.location))
