"""Sweeping: every edge by itself, from its source state, checked on sensed facts."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.hosting import known_world, make_host
from smsl_studio.front.trying import edge_alone
from smsl_studio.host.protocol import Host
from smsl_studio.library.operation_library import TABLE
from smsl_studio.runlog.events import (
    EdgeSwept,
    SweepFinished,
)


def sweep(
    blueprint: Blueprint,
    world: str = TABLE,
    *,
    seed: int = 0,
    host: str = "local",
    plugin_paths: Sequence[Path] = (),
) -> Iterator[EdgeSwept | SweepFinished]:
    """One event an edge as it is done, in written order, and a summary last.

    Each edge starts in its source state (its subs as clause 3 says, its bases where they agree) and
    is asked by hand. It passes when it is committed. Findings refuse nothing here: a sweep is how
    one looks at them. RunRefused where the SUB_SBS go round in a circle; WorldError for a world
    that does not exist or does not suit the blueprint.
    """
    loaded = known_world(world, plugin_paths, host)
    hierarchy = Hierarchy(blueprint)

    def fresh() -> Host:
        return make_host(blueprint, world, seed, host, plugin_paths=plugin_paths, loaded=loaded)

    place = fresh()
    time, passed, failed = 0.0, 0, []
    try:
        for branch in blueprint:
            for edge in branch.edges():
                swept, lost = edge_alone(hierarchy, place, edge.address, edge.target, seed)
                time += swept.t
                passed += swept.passed
                failed += [] if swept.passed else [swept.address]
                yield swept
                if lost:
                    place.close()
                    place = fresh()
    finally:
        place.close()
    yield SweepFinished(t=time, edges=passed + len(failed), passed=passed, failed=tuple(failed))
