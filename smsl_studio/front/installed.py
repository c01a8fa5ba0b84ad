"""Lists the plugins, and allows or forbids them."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from smsl_studio.errors import UsageError, did_you_mean
from smsl_studio.host.plugin_offers import describe
from smsl_studio.library.generated_proposal import GeneratedProposal, proposal_at
from smsl_studio.library.loaded import Loaded
from smsl_studio.library.permission import allow, forbid
from smsl_studio.library.survey import FoundPlugin, survey


def plugins(plugin_paths: Sequence[Path] = ()) -> Loaded:
    """Return all loaded plugins with their offers, the waiting plugins, and the faults.

    Their code runs in a child process, never in this one. ``plugin_paths`` are searched first.

    >>> [plugin.name for plugin in plugins().plugins]
    ['chess', 'hanoi', 'registration', 'river']
    """
    return describe(plugin_paths)


def allow_plugin(name: str) -> FoundPlugin:
    """Allow a plugin, by its name or its folder, as long as its files do not change.

    UsageError if there is no such plugin, or more than one. PluginError if it cannot be loaded at
    all. SaveError if the decision cannot be written.

    >>> allow_plugin("hanoi").state.value
    'allowed'
    """
    return allow(plugin_called(name))


def generated_functions(folder: str | Path) -> GeneratedProposal | None:
    """Return the generated functions in a folder such as ``made/rmm``, which wait to be read. None
    if there are none. Nothing of them is loaded. PluginError if they do not fit.

    >>> generated_functions("nowhere") is None
    True
    """
    return proposal_at(Path(folder))


def allow_generated(waiting: GeneratedProposal, read: str) -> FoundPlugin:
    """Allow generated functions that a person has read. Exactly this code is loaded from then on,
    in a process of its own, and it counts in a world once it has passed its sweep there.

    ``read`` is the SHA-256 of what was read (``waiting.digest``), or its beginning. UsageError for
    another, PluginError for code that reaches out of its world, SaveError if it cannot be written.
    """
    return allow(waiting.install(read), read=True)


def forbid_plugin(name: str) -> FoundPlugin:
    """Forbid a plugin, by its name or its folder, even if its files change later. It raises the
    same UsageError and SaveError as ``allow_plugin``.

    >>> forbid_plugin("hanoi").state.value
    'forbidden'
    """
    return forbid(plugin_called(name))


def plugin_called(name: str) -> FoundPlugin:
    """Return the plugin with this name or location. UsageError if there is none, or more than
    one."""
    every = [found for found in survey() if found.name]
    fitting = [found for found in every if name in (found.name, found.location)]
    if len(fitting) == 1:
        return fitting[0]
    if not fitting:
        names = sorted({found.name for found in every})
        near = did_you_mean(name, names)
        raise UsageError(
            f"there is no plugin {name!r}",
            advice=near or f"There are {', '.join(names)}.",
        )
    places = ", ".join(found.location for found in fitting)
    raise UsageError(
        f"there are {len(fitting)} plugins {name!r}: {places}",
        advice="Say which by its place instead of its name.",
    )
