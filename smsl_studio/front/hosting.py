"""Where a world lives: in this process or in a child; which worlds there are."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.host.describing import describe
from smsl_studio.host.protocol import Host
from smsl_studio.library.loading import Loaded, discover
from smsl_studio.library.operation_library import TABLE

if TYPE_CHECKING:
    from smsl_studio.host.spare import Spare


def make_host(
    blueprint: Blueprint,
    world: str,
    seed: int,
    host: str,
    *,
    plugin_paths: Sequence[Path] = (),
    loaded: Loaded | None = None,
    spare: Spare | None = None,
) -> Host:
    """A local or a process host; ``loaded`` spares the local one looking for plugins again,
    ``spare`` has a child in waiting for the other."""
    if host == "local":
        from smsl_studio.host.local import LocalHost

        return LocalHost(blueprint, world, seed, plugin_paths, loaded)
    from smsl_studio.host.process import ProcessHost

    return ProcessHost(blueprint, world, seed, plugin_paths, spare=spare)


def make_ready(spare: Spare, blueprint: Blueprint, world: str, seed: int) -> None:
    """Have a child of ``spare`` build this world, ready for a run that may come; does not wait."""
    from smsl_studio.host.process import ProcessHost

    spare.warm(ProcessHost(blueprint, world, seed).recipe)


def known_world(
    world: str, plugin_paths: Sequence[Path] = (), host: str = "local"
) -> Loaded | None:
    """The plugins, if the world needs any; WorldError with a near name where there is none.

    For a run whose world lives in a child no plugin's code runs here: it is described.
    """
    if world == TABLE:
        return None
    loaded = discover(plugin_paths) if host == "local" else describe(plugin_paths)
    loaded.world(world)
    return loaded


def worlds(plugin_paths: Sequence[Path] = ()) -> tuple[str, ...]:
    """The names of the worlds there are, ``table`` first."""
    return discover(plugin_paths).worlds
