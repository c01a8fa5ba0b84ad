"""A preview: what the world simulator predicts for one operation, compared with what the blueprint
declares. Nothing is recorded.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import replace

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy, start_configuration
from smsl_studio.blueprint.digests import digests
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.dispatch.route.effort import refuse_too_large
from smsl_studio.errors import UsageError
from smsl_studio.front.forecasts import Forecast, carried, terms_of
from smsl_studio.front.hosts import known_world, make_host, with_robot
from smsl_studio.front.logs import replay
from smsl_studio.front.request import RunRequest, Several, several
from smsl_studio.front.runs import open_request
from smsl_studio.front.script.addresses import Written, operations_at, states_at
from smsl_studio.front.starts import start_for_edge
from smsl_studio.library.loaded import Loaded
from smsl_studio.runlog.events import (
    Committed,
    OperationStarted,
    Relocalised,
    RunStarted,
)
from smsl_studio.world.engines import TABLE

MOST = 10_000
"""The largest number of repeats and of operations ahead."""


def preview(
    blueprint: Blueprint,
    edge: Written,
    world: str = TABLE,
    *,
    start: Several = None,
    log: str | os.PathLike[str] | None = None,
    ahead: int = 1,
    repeats: int = 1,
    seed: int = 0,
    robot: str = "",
) -> Forecast:
    """Carry one operation out in a simulated world, and compare the facts.

    It begins in the source of the operation, in ``start``, or in the last configuration of a
    ``log``. ``ahead`` counts the operations on the route, this one included. ``repeats`` are run
    with the seeds from ``seed`` up. UsageError if the operation does not leave the start,
    AddressError for an unknown address, WorldError for a world that does not suit the blueprint.

    >>> told = preview(read("hanoi-2.json"), "State_aa/Op_1b")
    >>> told.agrees, told.after
    (True, {'SB1/0': 'b', 'SB1/1': 'a'})
    """
    if not 1 <= repeats <= MOST or not 1 <= ahead <= MOST:
        raise UsageError(f"repeats and operations ahead are whole numbers from 1 to {MOST:,}")
    found = operations_at(blueprint, [edge])
    if len(found) != 1:
        raise UsageError(
            f"{edge} stands for {len(found)} operations", advice="Write SB/State/Operation."
        )
    (address,) = found
    hierarchy = Hierarchy(blueprint)
    refuse_too_large(hierarchy)
    begun = _start(hierarchy, address, start, log)
    loaded = known_world(world)
    request = with_robot(RunRequest(blueprint, world, host="local", robot=robot), loaded)
    previews = [
        _once(
            hierarchy,
            loaded,
            replace(request, seed=number),
            address,
            begun,
            ahead,
        )
        for number in range(seed, seed + repeats)
    ]
    share = sum(one.agrees for one in previews) / repeats
    return replace(previews[0], share=share)


def _start(
    hierarchy: Hierarchy,
    edge: Address,
    start: Several,
    log: str | os.PathLike[str] | None,
) -> Mapping[str, str]:
    given: Mapping[str, str] = {}
    if start is not None:
        states = states_at(hierarchy.blueprint, several(start), "start")
        given = start_configuration(hierarchy, {at.branch: at.state for at in states})
    elif log is not None:
        given = _last(hierarchy.blueprint, log)
    else:
        given = start_for_edge(hierarchy, edge) or {edge.branch: edge.state}
    if given.get(edge.branch) != edge.state:
        where = given.get(edge.branch, "no state")
        raise UsageError(
            f"{edge} does not leave the start: {edge.branch} is in {where}",
            advice=f"Start in {edge.branch}/{edge.state}.",
        )
    return given


def _last(blueprint: Blueprint, log: str | os.PathLike[str]) -> Mapping[str, str]:
    """Return the last configuration of a log. UsageError if it has none, or is of another
    blueprint.
    """
    told = replay(log)
    known = told.header.get("digests")
    if isinstance(known, Mapping) and known.get("behaviour") != digests(blueprint).behaviour:
        raise UsageError(f"{log} is the log of another blueprint", advice="Name one of this file.")
    found: dict[str, str] = {}
    for event in told.events:
        if isinstance(event, RunStarted):
            found = dict(event.start)
        elif isinstance(event, Committed | Relocalised):
            # An event names the SBs that moved.
            found |= event.configuration
    if not found:
        raise UsageError(f"{log} has no moment at which a state was known")
    return found


def _once(
    hierarchy: Hierarchy,
    loaded: Loaded | None,
    request: RunRequest,
    edge: Address,
    start: Mapping[str, str],
    ahead: int,
) -> Forecast:
    host = make_host(request, loaded)
    try:
        dispatcher = Dispatcher(hierarchy.blueprint, host, terms_of(start, request.seed))
        list(dispatcher.open())
        if dispatcher.finished:
            sentence = dispatcher.standing.sentence
            return Forecast(str(edge), {}, {}, {}, False, 0.0, sentence=sentence)
        found = [carried(hierarchy, host, dispatcher, edge)]
        if ahead > 1 and found[0].agrees:
            for following in _route(request.blueprint, dispatcher.standing.configuration, ahead):
                found.append(carried(hierarchy, host, dispatcher, following))
                if not found[-1].agrees:
                    break
        return replace(found[0], then=tuple(found[1:]))
    finally:
        host.close()


def _route(blueprint: Blueprint, start: Mapping[str, str], ahead: int) -> list[Address]:
    """Return the operations with which a run goes on from here, one fewer than ``ahead``: those of
    a run without physics.
    """
    starts = tuple(Address(branch, state) for branch, state in start.items())
    found: list[Address] = []
    dispatcher = open_request(RunRequest(blueprint, TABLE, starts=starts, host="local"))
    try:
        dispatcher.open()
        while not dispatcher.finished and len(found) < ahead - 1:
            found += [
                Address(*Address.split(event.address))
                for event in dispatcher.tick()
                if isinstance(event, OperationStarted)
            ]
    finally:
        dispatcher.close()
    return found[: ahead - 1]
