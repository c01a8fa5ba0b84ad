"""Which plugins there are, and which of them may be loaded."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from smsl_studio.errors import UsageError, did_you_mean
from smsl_studio.host.plugin_offers import describe
from smsl_studio.library.loading import Loaded
from smsl_studio.library.permission import allow, forbid
from smsl_studio.library.survey import FoundPlugin, survey


def plugins(plugin_paths: Sequence[Path] = ()) -> Loaded:
    """Every plugin that is loaded with what it offers, those that wait, and those with a fault.

    Their code runs in a child process, never in this one. ``plugin_paths`` are searched first.

    >>> [plugin.name for plugin in plugins().plugins]
    ['hanoi']
    """
    return describe(plugin_paths)


def allow_plugin(name: str) -> FoundPlugin:
    """Allow a plugin, by its name or its folder, as long as its files stay what they are now.

    UsageError where no plugin is called so, or several are.

    >>> allow_plugin("hanoi").state.value
    'allowed'
    """
    return allow(plugin_called(name))


def forbid_plugin(name: str) -> FoundPlugin:
    """Forbid a plugin, by its name or its folder, whatever its files become; see ``allow_plugin``.

    >>> forbid_plugin("hanoi").state.value
    'forbidden'
    """
    return forbid(plugin_called(name))


def plugin_called(name: str) -> FoundPlugin:
    """The plugin that is called so, or stands there; UsageError where that is none, or several."""
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
