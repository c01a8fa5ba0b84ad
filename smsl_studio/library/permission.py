"""Allows and forbids plugins, for the command line and the window."""

from __future__ import annotations

from dataclasses import replace

from smsl_studio.errors import PluginError
from smsl_studio.library.decisions import PluginDecision, decide
from smsl_studio.library.survey import USER, FoundPlugin, PluginState


def allow(found: FoundPlugin, *, read: bool = False) -> FoundPlugin:
    """Allow a plugin to be loaded. Generated functions must have been ``read`` as a difference.

    For a plugin in the user's folder this holds only for the files that were found: changed files
    need a new decision. PluginError if the plugin cannot be loaded at all. SaveError if the
    decision cannot be written.
    """
    if found.error is not None:
        raise found.error
    if found.is_generated and not read:
        raise PluginError(
            f"{found.name} holds generated functions, and nobody has read this difference",
            advice="Read them where they were made: smsl-studio plugins allow FOLDER",
        )
    decision = PluginDecision(
        location=found.location, name=found.name, decision="allowed", digest=found.digest
    )
    # Only plugins in the user's folder need a permission, so no other permission is written.
    decide(decision, forget=found.source != USER)
    return replace(found, state=PluginState.ALLOWED)


def forbid(found: FoundPlugin) -> FoundPlugin:
    """Forbid a plugin, even if its files change later. SaveError if the decision cannot be
    written."""
    decide(PluginDecision(location=found.location, name=found.name, decision="forbidden"))
    return replace(found, state=PluginState.FORBIDDEN, error=None)
