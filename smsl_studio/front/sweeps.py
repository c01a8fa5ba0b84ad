"""A sweep: runs every edge alone, from its source state, and checks sensed facts."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence
from pathlib import Path

from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.route.effort import refuse_too_large, refuse_too_many_edges
from smsl_studio.errors import UsageError, did_you_mean
from smsl_studio.front.generated_trials import GeneratedTrials
from smsl_studio.front.hosts import known_world, make_host, with_robot
from smsl_studio.front.request import RunRequest
from smsl_studio.front.single_edge import edge_alone
from smsl_studio.host.protocol import Host
from smsl_studio.library.generated_trials import FunctionTrial
from smsl_studio.runlog.events import (
    EdgeSwept,
    SweepFinished,
)
from smsl_studio.world.engines import TABLE


def sweep(
    blueprint: Blueprint,
    world: str = TABLE,
    *,
    seed: int = 0,
    host: str = "local",
    plugin_paths: Sequence[Path] = (),
    branches: Collection[str] = (),
    most: int | None = None,
    robot: str = "",
    operations: Collection[str] = (),
    tried: Callable[[FunctionTrial], None] | None = None,
) -> Iterator[EdgeSwept | SweepFinished]:
    """Run every edge alone. Yield one event for each edge, in written order, and a summary last.

    Each edge starts in its source state, with its sub-SBs as in clause 3 and its bases in states
    that agree. An edge passes if it is committed. Findings refuse no sweep, because a sweep helps
    to examine them. ``branches`` are the SBs to sweep, ``operations`` the names of operations;
    empty means all. ``most`` is the largest
    number of edges (see ``dispatch.route.effort``). RunRefused if there are more edges, or if the
    SUB_SBS have a cycle. WorldError for a world that does not exist or does not suit the blueprint.
    UsageError for a ``robot`` that the world does not have, or an operation that there is not.

    Generated functions are tried, too. One of which all edges pass is offered in this world from
    then on (see ``library.generated_trials``). ``tried`` is called with each of them at the end. A
    sweep with another ``robot`` than the usual one decides nothing about them.

    >>> *edges, summary = sweep(read("hanoi-2.json"))
    >>> summary.passed, summary.edges
    (24, 24)
    """
    chosen = [blueprint[name] for name in dict.fromkeys(branches)] or list(blueprint)
    hierarchy = Hierarchy(blueprint)
    refuse_too_large(hierarchy)
    refuse_too_many_edges(hierarchy, chosen, most)
    loaded = known_world(world, plugin_paths, host)
    paths = tuple(plugin_paths)
    request = RunRequest(
        blueprint, world, seed=seed, host=host, plugin_paths=paths, robot=robot, trial=True
    )
    request = with_robot(request, loaded)
    trials = GeneratedTrials(blueprint, world, loaded)
    known = {edge.name for branch in chosen for edge in branch.edges()}
    for name in operations:
        if name not in known:
            advice = did_you_mean(name, sorted(known))
            raise UsageError(f"no operation is called {name!r}", advice=advice)

    def fresh() -> Host:
        """Return a new host, so that a lost host does not affect the next edge."""
        return make_host(request, loaded)

    place = fresh()
    time, passed, failed = 0.0, 0, []
    try:
        for branch in chosen:
            for edge in branch.edges():
                if operations and edge.name not in operations:
                    continue
                swept, lost = edge_alone(hierarchy, place, edge.address, edge.target, seed)
                time += swept.t
                passed += swept.passed
                failed += [] if swept.passed else [swept.address]
                trials.add(edge.address, edge.target, swept)
                yield swept
                if lost:
                    place.close()
                    place = fresh()
    finally:
        place.close()
    if not request.robot:
        for trial in trials.kept():
            if tried is not None:
                tried(trial)
    yield SweepFinished(t=time, edges=passed + len(failed), passed=passed, failed=tuple(failed))
