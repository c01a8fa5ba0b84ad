"""One run of a campaign: its seed, and the fault that is injected in one operation. Pool workers
carry it out, each with its own blueprint and plugins.
"""

from __future__ import annotations

import hashlib
import signal
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import Place
from smsl_studio.front.inputs import read
from smsl_studio.front.request import RunRequest
from smsl_studio.front.runs import Run, run_request
from smsl_studio.front.script.script import DURING, WHEN, Act, Script, Trigger
from smsl_studio.front.starts import start_for_edge
from smsl_studio.runlog.events import OperationRisky, Relocalised, RoutePlanned
from smsl_studio.world.engines import TABLE

Json = Any
BY = "campaign"


@dataclass(frozen=True, slots=True)
class Injection:
    """A fault in one operation. ``begins`` says that the run starts with this operation, because
    the usual way does not lead through it.
    """

    fault: str
    edge: Address
    given: Mapping[str, Json] = field(default_factory=dict)
    begins: bool = False


@dataclass(frozen=True, slots=True)
class CampaignRun:
    """What is asked for one run: a world, a seed, and a fault or None."""

    world: str
    seed: int
    injection: Injection | None = None


@dataclass(frozen=True, slots=True)
class RunVerdict:
    """How one run ended. ``sha256`` is that of the bytes that ``run`` prints (JSON events).

    ``recovered`` says that the goal was reached although something went wrong on the way.
    """

    reached: bool
    recovered: bool
    reason: str
    sha256: str


def request_of(blueprint: Blueprint, asked: CampaignRun) -> RunRequest:
    """Return the request of a run."""
    injection = asked.injection
    if injection is None:
        return RunRequest(blueprint, asked.world, seed=asked.seed, host="local")
    place, edge = Place(BY, 1, 1), str(injection.edge)
    source = str(Address(injection.edge.branch, injection.edge.state))
    # A fault of the table world spoils the next operation, others act on the one that runs.
    trigger = Trigger(WHEN, 0.0, source) if asked.world == TABLE else Trigger(DURING, 0.0, edge)
    acts = [Act(place, trigger, "inject", {"fault": injection.fault, **injection.given}, BY)]
    starts: tuple[Address, ...] = ()
    if injection.begins:
        start = start_for_edge(Hierarchy(blueprint), injection.edge) or {}
        starts = tuple(Address(branch, state) for branch, state in start.items())
        ask = Act(place, Trigger(WHEN, 0.0, source), "ask", {"address": edge}, BY)
        acts = [acts[0], ask] if asked.world == TABLE else [ask, acts[0]]
    script = Script("", tuple(acts))
    return RunRequest(
        blueprint,
        asked.world,
        starts=starts,
        seed=asked.seed,
        host="local",
        script=script,
        attended=True,
    )


def judged(blueprint: Blueprint, asked: CampaignRun) -> RunVerdict:
    """Carry out one run, and judge it."""
    done = run_request(request_of(blueprint, asked))
    return RunVerdict(
        reached=done.reason == "goal_reached",
        recovered=done.reason == "goal_reached" and _was_disturbed(done),
        reason=done.reason,
        sha256=printed(done),
    )


def printed(done: Run) -> str:
    """Return the SHA-256 of the bytes that ``run --format json`` prints."""
    whole = hashlib.sha256()
    for event in done.events:
        whole.update(f"{event.line()}\n".encode())
    return whole.hexdigest()


def _was_disturbed(done: Run) -> bool:
    planned = sum(isinstance(event, RoutePlanned) for event in done.events)
    return planned > 1 or any(isinstance(e, OperationRisky | Relocalised) for e in done.events)


# -- in a worker ---------------------------------------------------------------------------------

_OWN: dict[str, Blueprint] = {}
"""The blueprint of this worker, by its file. A worker has one."""


def begin(file: str) -> None:
    """Read the blueprint of this worker. Ctrl-C is for the campaign, which ends its workers."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    _OWN[file] = read(Path(file))


def judged_there(file: str, asked: CampaignRun) -> RunVerdict:
    """Carry out one run in a worker."""
    return judged(_OWN[file], asked)
