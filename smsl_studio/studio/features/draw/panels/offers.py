"""What the installed plugins offer to a blueprint, for the library panel and the source."""

from __future__ import annotations

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.library.loaded import Loaded
from smsl_studio.studio.features.draw.panels.library import LibraryEntry


def offers(loaded: Loaded, blueprint: Blueprint) -> tuple[LibraryEntry, ...]:
    """Every operation that plugins offer, with the names of the blueprint that it matches."""
    names = sorted({name for branch in blueprint for name in branch.operation_names})
    found = []
    for plugin in loaded.plugins:
        for entry in plugin.library.operations:
            pattern = entry.pattern
            fits = tuple(n for n in names if pattern and pattern.match(n) is not None)
            found.append(LibraryEntry(pattern.text if pattern else entry.name, plugin.name, fits))
    return tuple(found)


def operation_names(loaded: Loaded) -> tuple[str, ...]:
    """The names of the operations that plugins offer; patterns are left out, and
    names that hold in one SB only."""
    entries = (entry for plugin in loaded.plugins for entry in plugin.library.operations)
    names = (entry.pattern.text if entry.pattern else entry.name for entry in entries)
    return tuple(sorted({name for name in names if not {"{", "/"} & set(name)}))
