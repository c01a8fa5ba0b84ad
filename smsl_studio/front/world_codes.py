"""Finds the code that a world binds to a blueprint, with the SHA-256 of each plugin."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import PluginError, WorldError
from smsl_studio.front.equipment import loaded_for
from smsl_studio.inspection.approval.statement import WorldCode
from smsl_studio.inspection.approval.world_code import (
    SignedBindings,
    heard_code,
    used_locations,
    world_code,
)
from smsl_studio.library.bindings import bind
from smsl_studio.library.bindings_file import BindingsFile, bindings_beside
from smsl_studio.library.loaded import Loaded
from smsl_studio.library.plugin_code import code_at
from smsl_studio.monitor.bus import SourceKey
from smsl_studio.world.engines import REMOTE, TABLE


@dataclass(frozen=True)
class WorldSurvey:
    """What a world has for a blueprint.

    ``code`` is None for a world without code, as the table world, unless remote sensors tell facts
    there (see ``heard_code``). ``locations`` has the SHA-256 of the
    code at each location; the process that loads the code compares it. ``rates`` has for each fact
    the readings a second (Hz) of its quickest sensor. ``missing`` says why there is no such world.
    ``loaded`` has the plugins, ``bindings`` the bindings file, and ``speakers`` the nodes that may
    speak for a source.
    """

    code: WorldCode | None = None
    locations: Mapping[str, str] = field(default_factory=dict)
    rates: Mapping[FactKey, float] = field(default_factory=dict)
    missing: str = ""
    loaded: Loaded | None = None
    bindings: BindingsFile | None = None
    speakers: Mapping[SourceKey, str] | None = None


NOWHERE = WorldSurvey()
"""The result if no world is asked about."""


def surveyed(blueprint: Blueprint, world: str, plugin_paths: Sequence[Path] = ()) -> WorldSurvey:
    """Return what a world has for a blueprint. No plugin code runs in this process."""
    try:
        file = bindings_beside(blueprint.file)
        signed = SignedBindings(file, _speakers(blueprint, file))
        if world == REMOTE:
            # Its code is elsewhere and is not signed. What it offers is known when it is opened.
            return WorldSurvey(heard_code(signed), bindings=file, speakers=signed.speakers)
        loaded = loaded_for(world, plugin_paths)
        bindings = bind(blueprint, loaded, world, file)
        rates: dict[FactKey, float] = {}
        for one in bindings.sensors:
            key = (one.branch, one.digit)
            rates[key] = max(rates.get(key, 0.0), 1 / one.period)
        if world == TABLE:
            heard = heard_code(signed)
            return WorldSurvey(heard, {}, rates, "", loaded, file, signed.speakers)
        locations = code_at(used_locations(world, loaded, bindings), plugin_paths)
        code = world_code(world, loaded, bindings, signed, locations)
        return WorldSurvey(code, locations, rates, "", loaded, file, signed.speakers)
    except (WorldError, PluginError) as error:
        return WorldSurvey(missing=str(error))


def _speakers(blueprint: Blueprint, file: BindingsFile) -> Mapping[SourceKey, str]:
    if not file.mqtt.room:
        return {}
    # Few blueprints have a room.
    from smsl_studio.front.elsewhere import speakers_of

    return speakers_of(blueprint.file, file)
