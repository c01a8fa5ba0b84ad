"""What is asked for a campaign, and which fault it injects in which operation."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.edges import Edges
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import UsageError, did_you_mean
from smsl_studio.front.campaign_runs import CampaignRun, Injection, request_of
from smsl_studio.front.hosts import known_world
from smsl_studio.front.runs import run_request
from smsl_studio.library.bindings import bind
from smsl_studio.library.bindings_file import bindings_beside
from smsl_studio.library.entries import FaultEntry
from smsl_studio.library.loaded import Loaded
from smsl_studio.library.table_faults import table_faults
from smsl_studio.runlog.events import OperationStarted
from smsl_studio.world.engines import TABLE

Json = Any
ALL, ROUTE = "all", "route"


@dataclass(frozen=True, slots=True)
class CampaignRequest:
    """What is asked for a campaign.

    ``seeds`` is the number of seeds, from 0. ``faults`` are names, or ``all``; without faults there
    is one row. ``edges`` is ``route`` (those of a run without fault) or ``all``. ``until`` is the
    width of the intervals at which the campaign ends early. ``resume`` takes over what an earlier
    campaign has kept in ``part``. ``dask`` is the address of a Dask scheduler, whose workers take
    the place of ``workers`` here. ``starts`` and ``goals`` are addresses, empty for the usual ones;
    a run that begins with a disturbed operation starts there. ``agents`` are automatic supervisors
    by name.

    >>> CampaignRequest(read("hanoi-2.json"), seeds=100, faults=("fail",)).edges
    'route'
    """

    blueprint: Blueprint
    world: str = TABLE
    seeds: int = 1
    faults: tuple[str, ...] = ()
    edges: str = ROUTE
    workers: int = 1
    until: float | None = None
    part: Path | None = None
    resume: bool = False
    robot: str = ""
    dask: str = ""
    starts: tuple[str, ...] = ()
    goals: tuple[str, ...] = ()
    agents: tuple[str, ...] = ()

    def run(self, seed: int, injection: Injection | None = None) -> CampaignRun:
        """Return what is asked for one run of it."""
        return CampaignRun(
            self.world, seed, injection, self.robot, self.starts, self.goals, self.agents
        )


def injections_of(request: CampaignRequest) -> list[Injection | None]:
    """Return the injections of a campaign in the order of its rows, [None] without faults."""
    return chosen_injections(request)[0]


def chosen_injections(
    request: CampaignRequest,
) -> tuple[list[Injection | None], tuple[str, ...]]:
    """Return the injections in the order of the rows, [None] without faults, and the names of
    faults that ``all`` leaves out."""
    if not request.faults:
        return [None], ()
    loaded = known_world(request.world)
    offered = loaded.faults_of(request.world) if loaded else table_faults(request.blueprint)
    names = list(offered) if request.faults == (ALL,) else list(dict.fromkeys(request.faults))
    for name in names:
        if name not in offered:
            near = did_you_mean(name, offered) or f"It has {', '.join(offered)}."
            raise UsageError(f"the world {request.world!r} has no fault {name!r}", advice=near)
    arguments = arguments_of(request.blueprint, request.world, loaded)
    route = _route(request)
    edges = route if request.edges == ROUTE else _all_edges(request.blueprint)
    found: list[Injection | None] = []
    left_out = []
    for name in names:
        own = [_injection(offered[name], edge, arguments, edge not in route) for edge in edges]
        if None not in own:
            found += own
        elif request.faults == (ALL,):
            left_out.append(name)
        else:
            missing = ", ".join(sorted(offered[name].signature.required))
            raise UsageError(
                f"the fault {name} needs {missing}, and no operation names it",
                advice="Use a script for this fault.",
            )
    if not edges:
        raise UsageError(
            "the run without a fault carries out no operation, so there is none to disturb",
            advice="Is a person needed? --edges all disturbs each operation of the blueprint.",
        )
    if not found:
        raise UsageError("no fault of this world can be injected without more words")
    return found, tuple(left_out)


def _injection(
    entry: FaultEntry,
    edge: Address,
    arguments: Mapping[Address, Mapping[str, Json]],
    begins: bool,
) -> Injection | None:
    """Return a fault in an edge. Its parameters are the arguments of the operation with the same
    names: a ring that is pushed is the one that is carried. None if one is missing."""
    own = arguments.get(edge, {})
    given = {name: own[name] for name in entry.signature.types if name in own}
    if entry.signature.required - set(given):
        return None
    return Injection(entry.name, edge, given, begins)


def _route(request: CampaignRequest) -> list[Address]:
    """Return the operations with a function that the run without a fault carries out, with seed
    0.
    """
    done = run_request(request_of(request.blueprint, request.run(0)))
    began = [e.address for e in done.events if isinstance(e, OperationStarted) and e.function]
    return [Address(*Address.split(text)) for text in dict.fromkeys(began)]


def _all_edges(blueprint: Blueprint) -> list[Address]:
    """Return the operations of a blueprint that have a function: others only move sub-SBs."""
    edges = Edges(Hierarchy(blueprint))
    return [
        edge.address
        for branch in blueprint
        for state in branch.table
        for edge in edges.out(branch.name, state)
        if edge.function
    ]


def arguments_of(
    blueprint: Blueprint, world: str, loaded: Loaded | None
) -> dict[Address, Mapping[str, Json]]:
    """Return the arguments of each operation's function in a world. Without plugins there are
    none."""
    if loaded is None:
        return {}
    bound = bind(blueprint, loaded, world, bindings_beside(blueprint.file)).operations
    return {address: one.arguments for address, one in bound.items()}
