"""Campaigns: many seeded runs of one blueprint in one world, without and with faults.

The result depends neither on the number of workers nor on the order in which runs end.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, closing, nullcontext
from dataclasses import asdict, dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from smsl_studio.errors import UsageError
from smsl_studio.front.campaign_batch import Judge, SeedBatch
from smsl_studio.front.campaign_faults import CampaignRequest, chosen_injections
from smsl_studio.front.campaign_part import CampaignPart
from smsl_studio.front.campaign_runs import (
    CampaignRun,
    Injection,
    RunVerdict,
    judged,
    request_of,
)
from smsl_studio.front.campaign_workers import CampaignWorkers
from smsl_studio.front.fault_foresight import FaultEnd
from smsl_studio.front.hosts import known_world, with_robot
from smsl_studio.front.request import RunRequest
from smsl_studio.stop import Stopped, heed
from smsl_studio.world.engines import TABLE

if TYPE_CHECKING:
    from smsl_studio.front.campaign_cluster import CampaignCluster

Json = Any
BLOCK = 20
"""With ``until`` seeds are run in blocks of this size, and only whole blocks are judged."""
Z = 1.959963984540054
"""The quantile of the normal distribution for an interval of 95 %."""
TOGETHER = 1_000
"""The number of runs that are handed to the workers at once."""
MOST = 1_000_000
"""The largest number of runs of a campaign."""


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


class CampaignWatch:
    """Watches a campaign. This one does nothing with what it hears."""

    def begin(self, rows: Sequence[Injection | None], seeds: int) -> None:
        """Hear the rows, and the number of seeds of each."""

    def foresee(self, row: int, end: FaultEnd) -> None:
        """Hear how the runs of a row were foreseen to end."""

    def hear(self, row: int, seed: int, verdict: RunVerdict) -> None:
        """Hear how a run of a row ended. It may raise Stopped; this run is kept then."""


class _Counted(CampaignWatch):
    """Counts the runs."""

    def __init__(self, told: Told) -> None:
        self._told, self._done, self._every = told, 0, 0

    def begin(self, rows: Sequence[Injection | None], seeds: int) -> None:
        """Hear how many runs there are."""
        self._every = len(rows) * seeds

    def hear(self, row: int, seed: int, verdict: RunVerdict) -> None:
        """Tell one run more."""
        self._done += 1
        self._told(self._done, self._every)


Told = Callable[[int, int], None]
"""Is called with the number of runs that are done, and of all."""


def campaign(
    request: CampaignRequest,
    told: Told = lambda _done, _all: None,
    watch: CampaignWatch | None = None,
) -> Campaign:
    """Run a campaign. ``watch`` hears of each run, in place of ``told``.

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
    injections, left_out = chosen_injections(request)
    if len(injections) * request.seeds > MOST:
        raise UsageError(
            f"these are {len(injections) * request.seeds:,} runs, and {MOST:,} are the most",
            advice="Take fewer seeds, faults or edges.",
        )
    # Workers that somebody asks for carry each run out.
    here = request.world == TABLE and request.workers == 1 and not request.dask
    batch = SeedBatch(request.blueprint) if here else None
    verdicts = _verdicts(request, injections, batch, watch or _Counted(told))
    rows = tuple(
        row_of(injection, own) for injection, own in zip(injections, verdicts, strict=True)
    )
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
    watch: CampaignWatch,
) -> list[list[RunVerdict]]:
    """Return the verdicts of each row, in the order of the seeds."""
    found: list[list[RunVerdict]] = [[] for _ in injections]
    watch.begin(injections, request.seeds)
    block = request.seeds if request.until is None else BLOCK
    with _pool(request) as pool, closing(CampaignPart(request.part, request.resume)) as part:
        judge = _judge(request, pool, batch)
        for look, first in enumerate(range(0, request.seeds, block), 1):
            seeds = range(first, min(first + block, request.seeds))
            asked = [request.run(seed, injection) for injection in injections for seed in seeds]
            for number, verdict in enumerate(_judged(request, asked, judge, part)):
                row = number // len(seeds)
                found[row].append(verdict)
                watch.hear(row, seeds[number % len(seeds)], verdict)
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


def row_of(injection: Injection | None, own: Sequence[RunVerdict]) -> CampaignRow:
    """Return the row of a fault in an edge, of the verdicts of its runs."""
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
