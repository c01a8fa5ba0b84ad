"""The phases of the command line in which a stop may come, with the command for each phase."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Scene:
    """One phase: the command, and where the program is when moments begin to be drawn.

    ``forks`` is the function (module:name) at which the program stands ready: each moment is a
    copy of the process that goes on from there. ``reached`` is the function with which the phase
    begins; where it is empty, code of the plugin says so, which behaves as ``stall`` has it.
    Moments are drawn from so many seconds (``span``) after that.
    """

    command: tuple[str, ...]
    forks: str
    reached: str = ""
    span: float = 0.4
    stall: str = ""
    fits: Callable[..., bool] = lambda *_, **__: True
    """Whether a call of ``forks`` is the one that is meant."""


def _is_large(blueprint: Any, *_: Any) -> bool:
    return bool(blueprint.state_count)


RUN = "smsl_studio.front.runs:run"
READ = "smsl_studio.cli.blueprint_argument:read"
REPLAY = "smsl_studio.cli.replay:execute"
LOG = ("--log", "run.jsonl", "--format", "json")
SLOWLY = ("--speed", "1", "--script")
_STALL = ("run", "{}/walk.json", "--world", "stall", *LOG)

SCENES = {
    "reading": Scene(("check", "{}/flat.json"), READ, READ, 1.0),
    "reading native": Scene(("check", "{}/flat.smsl"), READ, READ, 2.0),
    "checking": Scene(
        ("check", "{}/flat.json"),
        "smsl_studio.cli.check:inspect",
        "smsl_studio.cli.check:inspect",
        2.0,
        fits=_is_large,
    ),
    "describing": Scene(("plugins",), "smsl_studio.cli.plugins:plugins", stall="describing"),
    "describing for a run": Scene(_STALL, RUN, stall="describing"),
    "building": Scene(_STALL, RUN, stall="building"),
    "building in this process": Scene((*_STALL, "--host", "local"), RUN, stall="building"),
    "planning": Scene(
        ("run", "{}/cube.json", "--world", "table", *LOG),
        RUN,
        "smsl_studio.dispatch.route.planner:Planner.legs",
        2.0,
    ),
    "planning a route": Scene(
        ("route", "{}/cube.json", "--sb", "BASE", "--from", "State_000000", "--to", "State_111111"),
        "smsl_studio.cli.route:plan_route",
        "smsl_studio.dispatch.route.planner:Planner.legs",
        2.0,
    ),
    "operation": Scene(_STALL, RUN, stall="operation"),
    "operation that hangs": Scene(_STALL, RUN, stall="hanging"),
    "operation that does not brake": Scene(_STALL, RUN, stall="braking"),
    "operation in this process": Scene((*_STALL, "--host", "local"), RUN, stall="operation"),
    "operation that hangs in this process": Scene(
        (*_STALL, "--host", "local"), RUN, stall="hanging"
    ),
    "sensing": Scene(_STALL, RUN, stall="sensing"),
    "waiting for people": Scene(
        ("run", "{}/human.json", "--world", "table", *SLOWLY, "{}/answer.jsonl", *LOG),
        RUN,
        "smsl_studio.dispatch.execution.desk:Desk.ask",
    ),
    "relocating": Scene(
        ("run", "{}/wide.json", "--world", "table", "--script", "{}/lost.jsonl", *LOG),
        RUN,
        "smsl_studio.dispatch.execution.recovery:_agreeing",
        0.002,
    ),
    "replay": Scene(
        ("replay", "{}/line.jsonl"),
        REPLAY,
        "smsl_studio.cli.replay:_tell",
        0.5,
    ),
    "verifying": Scene(
        ("replay", "{}/line.jsonl", "--verify"),
        REPLAY,
        "smsl_studio.front.logs:verify_log",
        0.2,
    ),
    "account": Scene(
        ("replay", "{}/line.jsonl", "-o", "account.html"),
        REPLAY,
        "smsl_studio.cli.replay:_account",
        0.3,
    ),
    "saving": Scene(
        ("convert", "{}/flat.json", "-o", "flat.smsl"),
        "smsl_studio.cli.convert:save_document",
        "smsl_studio.cli.convert:save_document",
        0.2,
    ),
}
