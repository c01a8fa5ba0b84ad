"""The functions and sensors of plugins that are bound by names alone.

No world is chosen yet, and no code of a plugin runs for the answer. So a plugin counts only if it
has a function for at least half of the operations of an SB.
"""

from __future__ import annotations

from collections.abc import Iterator

from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.library.loaded import Loaded, Plugin


def function_by_name(loaded: Loaded, branch: StateBranch, name: str) -> str:
    """Return the full name of the function that is bound to an operation of this name. It is empty
    if there is none."""
    for plugin in _at_home(loaded, branch):
        for entry in plugin.library.operations:
            if entry.texts(branch.name, name) is not None:
                return entry.name
    return ""


def sensors_by_name(
    loaded: Loaded, blueprint: Blueprint, branch: StateBranch, digit: int
) -> tuple[str, ...]:
    """Return the names of the sensors of plugins that read a fact."""
    # It checks manifests with pydantic, which the first picture of a window does not need.
    from smsl_studio.library.bindings import texts_read

    found: dict[str, None] = {}
    note = branch.fact_note(digit)
    named = note.sensors if note is not None else ()
    for plugin in _at_home(loaded, branch):
        for entry in plugin.library.sensors:
            if named:
                found |= {one: None for one in named if entry.pattern.match(one) is not None}
                continue
            texts = texts_read(blueprint, entry, branch.name, digit)
            if texts is not None:
                found[entry.pattern.fill(texts)] = None
    return tuple(found)


def _at_home(loaded: Loaded, branch: StateBranch) -> Iterator[Plugin]:
    names = branch.operation_names
    for plugin in loaded.plugins:
        entries = plugin.library.operations
        known = sum(any(e.texts(branch.name, name) is not None for e in entries) for name in names)
        if known and 2 * known >= len(names):
            yield plugin
