"""Allowing and forbidding a plugin: what the command line and the window do alike."""

from __future__ import annotations

from dataclasses import replace

from smsl_studio.library.decisions import PluginDecision, decide
from smsl_studio.library.survey import USER, FoundPlugin, PluginState


def allow(found: FoundPlugin) -> FoundPlugin:
    """Allow a plugin to be loaded; one in the user's folder only as long as its files stay so.

    It is what was found that is allowed: files that have changed since are not. PluginError for
    one that cannot be loaded at all; SaveError where the decision cannot be written.
    """
    if found.error is not None:
        raise found.error
    decision = PluginDecision(
        location=found.location, name=found.name, decision="allowed", digest=found.digest
    )
    # What needs no permission is not written down.
    decide(decision, forget=found.source != USER)
    return replace(found, state=PluginState.ALLOWED)


def forbid(found: FoundPlugin) -> FoundPlugin:
    """Let no code of a plugin be loaded, whatever its files become; SaveError as above."""
    decide(PluginDecision(location=found.location, name=found.name, decision="forbidden"))
    return replace(found, state=PluginState.FORBIDDEN, error=None)
