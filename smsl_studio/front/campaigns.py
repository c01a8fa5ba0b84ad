"""Campaigns: many seeded runs of one blueprint in one world, without and with faults.

The result depends neither on the number of workers nor on the order in which runs end.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, closing, nullcontext
from dataclasses import asdict, dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.edges import Edges
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import UsageError, did_you_mean
from smsl_studio.front.campaign_batch import Judge, SeedBatch
from smsl_studio.front.campaign_part import CampaignPart
from smsl_studio.front.campaign_runs import (
    CampaignRun,
    Injection,
    RunVerdict,
    judged,
    request_of,
)
from smsl_studio.front.campaign_workers import CampaignWorkers
from smsl_studio.front.hosts import known_world, with_robot
from smsl_studio.front.request import RunRequest
from smsl_studio.front.runs import run_request
from smsl_studio.library.bindings import bind
from smsl_studio.library.bindings_file import bindings_beside
from smsl_studio.library.entries import FaultEntry
from smsl_studio.library.loaded import Loaded
from smsl_studio.library.table_faults import table_faults
from smsl_studio.runlog.events import OperationStarted
from smsl_studio.stop import Stopped, heed
from smsl_studio.world.engines import TABLE

if TYPE_CHECKING:
    from smsl_studio.front.campaign_cluster import CampaignCluster

Json = Any
ALL, ROUTE = "all", "route"
BLOCK = 20
"""With ``until`` seeds are run in blocks of this size, and only whole blocks are judged."""
Z = 1.959963984540054
"""The quantile of the normal distribution for an interval of 95 %."""
TOGETHER = 1_000
"""The number of runs that are handed to the workers at once."""
MOST = 1_000_000
"""The largest number of runs of a campaign."""


@dataclass(frozen=True, slots=True)
class CampaignRequest:
    """What is asked for a campaign.

    ``seeds`` is the number of seeds, from 0. ``faults`` are names, or ``all``; without faults there
    is one row. ``edges`` is ``route`` (those of a run without fault) or ``all``. ``until`` is the
    width of the intervals at which the campaign ends early. ``resume`` takes over what an earlier
    campaign has kept in ``part``. ``dask`` is the address of a Dask scheduler, whose workers take
    the place of ``workers`` here.

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


@dataclass(frozen=True, slots=True)
class CampaignRow:
    """The runs of one fault in one edge, or those without a fault.

    ``low`` and ``high`` are the 95 % Wilson interval of the share of runs that reached the goal.
    """

    fault: str | None
    edge: str | None
    runs: int
    reached: int
    held: int
    recovered: int
    low: float
    high: float


@dataclass(frozen=True, slots=True)
class Campaign:
    """The result of a campaign. ``left_out`` are faults whose parameters nobody can choose.

    ``made`` counts the runs whose bytes were made from those of another seed, in the table world,
    and ``alone`` says why others there were carried out one by one. Equal campaigns may differ in
    both.
    """

    runs: int
    reached: int
    digest: str
    rows: tuple[CampaignRow, ...]
    left_out: tuple[str, ...] = ()
    made: int = field(default=0, compare=False)
    alone: str = field(default="", compare=False)

    def as_json(self) -> dict[str, Json]:
        """Return the result as plain values."""
        rows = [asdict(row) for row in self.rows]
        return {"runs": self.runs, "reached": self.reached, "digest": self.digest, "rows": rows}


Told = Callable[[int, int], None]
"""Is called with the number of runs that are done, and of all."""


def campaign(request: CampaignRequest, told: Told = lambda _done, _all: None) -> Campaign:
    """Run a campaign.

    UsageError for a robot or a fault that the world does not have, or whose parameters nobody can
    choose; for numbers that do not fit; or for more than 1,000,000 runs. WorldError if there is no
    such world, or if a worker dies.

    >>> done = campaign(CampaignRequest(read("hanoi-2.json"), seeds=3))
    >>> done.runs, done.reached, len(done.rows)
    (3, 3, 1)
    """
    if request.seeds < 1 or request.workers < 1:
        raise UsageError("a campaign needs at least one seed and one worker")
    if request.dask and request.workers > 1:
        raise UsageError("a campaign has workers here or on a cluster", advice="Name one of both.")
    if request.world != TABLE or request.robot:
        # A worker could not say more of a wrong name than that it ended.
        named = RunRequest(request.blueprint, request.world, robot=request.robot)
        known = known_world(request.world, host="process")
        request = replace(request, robot=with_robot(named, known).robot)
    injections, left_out = _chosen(request)
    if len(injections) * request.seeds > MOST:
        raise UsageError(
            f"these are {len(injections) * request.seeds:,} runs, and {MOST:,} are the most",
            advice="Take fewer seeds, faults or edges.",
        )
    # Workers that somebody asks for carry each run out.
    here = request.world == TABLE and request.workers == 1 and not request.dask
    batch = SeedBatch(request.blueprint) if here else None
    verdicts = _verdicts(request, injections, batch, told)
    rows = tuple(_row(injection, own) for injection, own in zip(injections, verdicts, strict=True))
    digest = hashlib.sha256()
    for own in verdicts:
        for one in own:
            digest.update(f"{one.sha256}\n".encode("ascii"))
    runs, reached = sum(row.runs for row in rows), sum(row.reached for row in rows)
    made, alone = (batch.made, batch.alone) if batch is not None else (0, "")
    return Campaign(runs, reached, digest.hexdigest(), rows, left_out, made, alone)


def wilson(reached: int, runs: int, z: float = Z) -> tuple[float, float]:
    """Return the Wilson interval of a share (E. B. Wilson, 1927)."""
    share, square = reached / runs, z * z / runs
    middle = (share + square / 2) / (1 + square)
    half = z * math.sqrt(share * (1 - share) / runs + square / (4 * runs)) / (1 + square)
    return max(0.0, middle - half), min(1.0, middle + half)


def _verdicts(
    request: CampaignRequest,
    injections: Sequence[Injection | None],
    batch: SeedBatch | None,
    told: Told,
) -> list[list[RunVerdict]]:
    """Return the verdicts of each row, in the order of the seeds."""
    found: list[list[RunVerdict]] = [[] for _ in injections]
    every = len(injections) * request.seeds
    block = request.seeds if request.until is None else BLOCK
    done = 0
    with _pool(request) as pool, closing(CampaignPart(request.part, request.resume)) as part:
        judge = _judge(request, pool, batch)
        for look, first in enumerate(range(0, request.seeds, block), 1):
            seeds = range(first, min(first + block, request.seeds))
            asked = [
                CampaignRun(request.world, seed, injection, request.robot)
                for injection in injections
                for seed in seeds
            ]
            for number, verdict in enumerate(_judged(request, asked, judge, part)):
                found[number // len(seeds)].append(verdict)
                done += 1
                told(done, every)
            if request.until is not None and _is_narrow(found, look, request.until):
                break
    return found


def _judge(
    request: CampaignRequest,
    pool: CampaignWorkers | CampaignCluster | None,
    batch: SeedBatch | None,
) -> Judge:
    """Return what carries runs out: the workers, or this process, which makes a batch of them."""

    def here(asked: Sequence[CampaignRun]) -> Iterator[RunVerdict]:
        return (judged(request.blueprint, one) for one in asked)

    if pool is not None:
        return pool.verdicts
    return here if batch is None else partial(batch.verdicts, judge=here)


def _judged(
    request: CampaignRequest,
    asked: Sequence[CampaignRun],
    judge: Judge,
    part: CampaignPart,
) -> Iterator[RunVerdict]:
    """Yield the verdicts in the order of ``asked``. What is known from before is not run again."""
    # Not all at once: a million runs that wait take much memory.
    for first in range(0, len(asked), TOGETHER):
        some = asked[first : first + TOGETHER]
        keys = [part.key(request_of(request.blueprint, one)) for one in some]
        anew = [one for one, key in zip(some, keys, strict=True) if key not in part.known]
        fresh = judge(anew)
        for key in keys:
            heed()
            if key not in part.known:
                verdict = next(fresh)
                if verdict.reason == "stopped":
                    # Somebody stopped the campaign, and with it this run.
                    raise Stopped
                part.keep(key, verdict)
            yield part.known[key]


def _pool(
    request: CampaignRequest,
) -> AbstractContextManager[CampaignWorkers | CampaignCluster | None]:
    """Give the workers. None for one worker in the table world: it runs no code of plugins, and is
    this process.
    """
    if request.dask:
        from smsl_studio.front.campaign_cluster import CampaignCluster

        return closing(CampaignCluster(request.dask, request.blueprint, request.world))
    if request.workers == 1 and request.world == TABLE:
        return nullcontext()
    file = request.blueprint.file
    if not Path(file).is_file():
        raise UsageError("workers need a blueprint in a file", advice="Save it first.")
    return closing(CampaignWorkers(file, request.workers))


def _is_narrow(found: Sequence[Sequence[RunVerdict]], look: int, width: float) -> bool:
    """Whether each interval is narrow enough, at the ``look``-th look.

    Who looks often finds a narrow interval by chance, so each look gets a smaller share of the 5 %:
    6 / (pi^2 look^2) of it, which are 5 % together (Bonferroni; the series is Euler's).
    """
    share = 0.05 * 6.0 / (math.pi * look) ** 2
    z = _quantile(1.0 - share / 2.0)
    for own in found:
        low, high = wilson(sum(one.reached for one in own), len(own), z)
        if high - low > width:
            return False
    return True


def _quantile(share: float) -> float:
    from statistics import NormalDist

    return NormalDist().inv_cdf(share)


def _row(injection: Injection | None, own: Sequence[RunVerdict]) -> CampaignRow:
    reached = sum(one.reached for one in own)
    low, high = wilson(reached, len(own))
    return CampaignRow(
        fault=injection.fault if injection else None,
        edge=str(injection.edge) if injection else None,
        runs=len(own),
        reached=reached,
        held=len(own) - reached,
        recovered=sum(one.recovered for one in own),
        low=round(low, 6),
        high=round(high, 6),
    )


# -- faults and edges ----------------------------------------------------------------------------


def injections_of(request: CampaignRequest) -> list[Injection | None]:
    """Return the injections of a campaign in the order of its rows, [None] without faults."""
    return _chosen(request)[0]


def _chosen(
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
    arguments = _arguments(request.blueprint, request.world, loaded)
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
    usual = CampaignRun(request.world, 0, robot=request.robot)
    done = run_request(request_of(request.blueprint, usual))
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


def _arguments(
    blueprint: Blueprint, world: str, loaded: Loaded | None
) -> dict[Address, Mapping[str, Json]]:
    if loaded is None:
        return {}
    bound = bind(blueprint, loaded, world, bindings_beside(blueprint.file)).operations
    return {address: one.arguments for address, one in bound.items()}
