"""Where a world lives: in this process or in a child; which worlds there are."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.request import RunRequest
from smsl_studio.host.plugin_offers import describe
from smsl_studio.host.protocol import Host
from smsl_studio.library.loading import Loaded, discover
from smsl_studio.world.engines import TABLE

if TYPE_CHECKING:
    from smsl_studio.host.spare import Spare


def make_host(
    request: RunRequest, loaded: Loaded | None = None, spare: Spare | None = None
) -> Host:
    """A local or a process host.

    ``loaded`` are plugins that were found already. A local host uses them as they are; the child of
    a process host loads those anew that serve the world, and no others. ``spare`` has a child in
    waiting for a process host.
    """
    blueprint, world, seed = request.blueprint, request.world, request.seed
    if request.host == "local":
        from smsl_studio.host.local import LocalHost

        return LocalHost(blueprint, world, seed, request.plugin_paths, loaded)
    from smsl_studio.host.process import ChildTerms, ProcessHost

    terms = ChildTerms(_locations(loaded, world))
    return ProcessHost(blueprint, world, seed, request.plugin_paths, terms, spare)


def make_ready(
    spare: Spare, blueprint: Blueprint, world: str, seed: int, loaded: Loaded | None = None
) -> None:
    """Have a child of ``spare`` build this world, ready for a run that may come; does not wait.

    It is ready for a run that is given the same ``loaded``.
    """
    from smsl_studio.host.process import ChildTerms, ProcessHost

    terms = ChildTerms(_locations(loaded, world))
    spare.warm(ProcessHost(blueprint, world, seed, terms=terms).recipe)


def _locations(loaded: Loaded | None, world: str) -> tuple[str, ...] | None:
    """Where the plugins stand that a run needs; None: nobody knows."""
    known = loaded is not None and world in loaded.worlds
    return loaded.locations(world) if loaded is not None and known else None


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
    """The names of the worlds there are, ``table`` first; no plugin's code runs here.

    >>> worlds()
    ('table', 'hanoi')
    """
    return describe(plugin_paths).worlds
