"""What a world has for a blueprint, and the findings about that."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from pathlib import Path

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.host.plugin_offers import describe
from smsl_studio.inspection.in_world import inspect_in_world
from smsl_studio.inspection.rules.finding import Finding
from smsl_studio.inspection.rules.world import Unreached
from smsl_studio.library.bindings import bind
from smsl_studio.library.bindings_file import bindings_beside
from smsl_studio.library.loaded import Loaded
from smsl_studio.world.engines import TABLE


def loaded_for(world: str, plugin_paths: Sequence[Path] = ()) -> Loaded:
    """Return the plugins that serve a world. The table world needs none.

    ``plugin_paths`` are searched before all other folders. No plugin code runs in this process.
    WorldError if there is no such world; it suggests a similar name.
    """
    if world == TABLE:
        return Loaded(())
    loaded = describe(plugin_paths)
    loaded.world(world)
    return loaded


def findings_in_world(
    blueprint: Blueprint,
    world: str,
    rules: Collection[str] | None = None,
    loaded: Loaded | None = None,
    robot: str = "",
) -> tuple[Finding, ...]:
    """Return the findings about a blueprint in a world, in the order of the text (R24 to R26).

    ``loaded`` are plugins that were found already. ``robot`` is the robot of the world, empty for
    the usual one. WorldError if there is no such world, UsageError if it has no such robot.
    """
    known = loaded if loaded is not None else loaded_for(world)
    bindings = bind(blueprint, known, world, bindings_beside(blueprint.file))
    reach = known.reach(world, robot)
    missed: tuple[tuple[str, str], ...] = ()
    if reach is not None and (rules is None or "R24" in rules):
        from smsl_studio.world.reach import unreached

        missed = unreached(reach)
    lack = Unreached(reach.robot, missed) if reach is not None and missed else None
    return inspect_in_world(blueprint, world, bindings, rules, lack)
