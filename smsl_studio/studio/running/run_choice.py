"""What a person chose to run, its request, and its log."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from datetime import datetime
from pathlib import Path

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.log_seals import seal_of_logs
from smsl_studio.front.recorder import new_recording, start_log
from smsl_studio.front.request import RunRequest
from smsl_studio.front.script.script import Script
from smsl_studio.library.loaded import Loaded
from smsl_studio.runlog.log import RunLog


@dataclass(frozen=True)
class RunChoice:
    """What a person has chosen for a run.

    ``start`` and ``goal`` are addresses; empty means the default. ``starts`` are start states of
    several SBs, and are used instead of ``start``. ``levels`` are the levels that were set for this
    run (see ``blueprint.levels``).
    """

    world: str
    start: str = ""
    goal: str = ""
    seed: int = 0
    by_hand: bool = False
    levels: Mapping[str, str] = field(default_factory=dict)
    starts: tuple[str, ...] = ()
    policy: Path | None = None
    """The trust policy that must be met; None if the run needs no approval."""
    script: Script | None = None
    """What is done by hand in this run, one act after the other."""
    robot: str = ""
    """The robot of the world; empty means its usual one."""
    agents: tuple[str, ...] = ()
    """Automatic supervisors by name."""
    forecast: str = ""
    """The level of forecasts; empty means none."""

    def request(self, blueprint: Blueprint) -> RunRequest:
        """The request for this run, with a person present to answer.

        A run by hand begins with the command of the person, so that the record tells it.
        """
        return RunRequest(
            blueprint,
            self.world,
            starts=self.starts or ((self.start,) if self.start else ()),
            goals=(self.goal,) if self.goal else (),
            seed=self.seed,
            levels=self.levels,
            attended=True,
            script=self.script,
            policy=self.policy,
            robot=self.robot,
            agents=self.agents,
            forecast=self.forecast,
        )


def log_of(request: RunRequest, loaded: Loaded | None, folder: Path, who: str) -> RunLog:
    """Start the log of a run; raises SaveError if it cannot be written, and SealError if the
    recorder's key does not open."""
    asked = request.checked()
    path = new_recording(folder, request.blueprint.file, datetime.now())
    seal = seal_of_logs()
    return start_log(replace(asked, log=path, person=who, seal=seal), loaded)
