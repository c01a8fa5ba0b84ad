"""One run of a campaign: its seed, and the fault that is injected in one operation. Pool workers
carry it out, each with its own blueprint and plugins.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import Place
from smsl_studio.front.request import RunRequest
from smsl_studio.front.runs import Run, run_request
from smsl_studio.front.script.addresses import Written
from smsl_studio.front.script.script import AT, DURING, WHEN, Act, Script, Trigger
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
    """What is asked for one run: a world, a seed, a fault or None, and a robot; where it starts and
    ends, and the automatic supervisors. Each may be left out.
    """

    world: str
    seed: int
    injection: Injection | None = None
    robot: str = ""
    starts: tuple[str, ...] = ()
    goals: tuple[str, ...] = ()
    agents: tuple[str, ...] = ()


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
        return RunRequest(
            blueprint,
            asked.world,
            starts=asked.starts,
            goals=asked.goals,
            seed=asked.seed,
            host="local",
            robot=asked.robot,
            agents=asked.agents,
        )
    place, edge = Place(BY, 1, 1), str(injection.edge)
    given = {"fault": injection.fault, **injection.given}
    if asked.world == TABLE:
        # A fault of the table waits for its operation; others act on the one that runs.
        acts = [Act(place, Trigger(AT, 0.0), "inject", {**given, "operation": edge}, BY)]
    else:
        acts = [Act(place, Trigger(DURING, 0.0, edge), "inject", given, BY)]
    starts: tuple[Written, ...] = asked.starts
    if injection.begins:
        start = start_for_edge(Hierarchy(blueprint), injection.edge) or {}
        starts = tuple(Address(branch, state) for branch, state in start.items())
        source = str(Address(injection.edge.branch, injection.edge.state))
        acts.append(Act(place, Trigger(WHEN, 0.0, source), "ask", {"address": edge}, BY))
    script = Script("", tuple(acts))
    return RunRequest(
        blueprint,
        asked.world,
        starts=starts,
        goals=asked.goals,
        agents=asked.agents,
        seed=asked.seed,
        host="local",
        script=script,
        attended=True,
        robot=asked.robot,
    )


def judged(blueprint: Blueprint, asked: CampaignRun) -> RunVerdict:
    """Carry out one run, and judge it."""
    return verdict_of(run_request(request_of(blueprint, asked)))


def verdict_of(done: Run) -> RunVerdict:
    """Judge a run that is over."""
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


# -- as plain values, for workers ------------------------------------------------------------------


def run_as_json(asked: CampaignRun) -> Json:
    """Return what is asked for a run as plain values."""
    values = asdict(asked)
    if asked.injection is not None:
        values["injection"]["edge"] = str(asked.injection.edge)
    return values


def run_of_json(values: Json) -> CampaignRun:
    """Return what is asked for a run, of the values that ``run_as_json`` gives."""
    told = values["injection"]
    injection = None
    if told is not None:
        injection = Injection(**{**told, "edge": Address(*Address.split(told["edge"]))})
    more = (tuple(values[name]) for name in ("starts", "goals", "agents"))
    return CampaignRun(values["world"], values["seed"], injection, values["robot"], *more)


def verdict_as_json(verdict: RunVerdict) -> dict[str, Json]:
    """Return a verdict as plain values."""
    return asdict(verdict)


def verdict_of_json(values: Json) -> RunVerdict | None:
    """Return the verdict in plain values. None if they are no verdict, or contradict themselves:
    they come from a file or from a process that ran the code of plugins.
    """
    if not isinstance(values, dict) or set(values) != set(_KINDS):
        return None
    if any(type(values[name]) is not kind for name, kind in _KINDS.items()):
        return None
    found = RunVerdict(**values)
    is_sound = (
        re.fullmatch(r"[0-9a-f]{64}", found.sha256)
        and len(found.reason) <= 100
        and found.reached == (found.reason == "goal_reached")
        and found.reached >= found.recovered
    )
    return found if is_sound else None


_KINDS = {"reached": bool, "recovered": bool, "reason": str, "sha256": str}
