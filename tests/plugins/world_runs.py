"""Runs of the physical worlds that ship, each under a random script: a fault, a pause, a sensor
that is disturbed. Equal worlds and numbers give equal runs."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from random import Random
from typing import Any

from smsl_studio.front.inputs import read
from smsl_studio.front.script.lines import script_of
from smsl_studio.shipped import samples_dir
from tests.front.any_run import AnyRun
from tests.plugins.faulted import PLAIN, cases
from tests.plugins.piece_games import CHESS, RIVER, file_of, game_faults
from tests.plugins.site_runs import FLAT, site_faults

HANOI, REGISTRATION = "hanoi", "registration"
WORLDS = (HANOI, RIVER, CHESS, REGISTRATION)

Json = Any


@dataclass(frozen=True)
class WorldRun(AnyRun):
    """A run in a world."""

    world: str

    @property
    def asked(self) -> dict[str, Any]:
        return {**super().asked, "world": self.world}


def blueprint_file(world: str) -> Path:
    """A correct blueprint of a world."""
    if world in (RIVER, CHESS):
        return file_of(world)
    return samples_dir() / {HANOI: PLAIN, REGISTRATION: FLAT}[world]


def faults_of(world: str) -> list[tuple[str, Mapping[str, float | str]]]:
    """Every fault of a world, with its parameters."""
    if world == HANOI:
        return [(case.fault, case.parameters) for case in cases()]
    found = site_faults() if world == REGISTRATION else game_faults(world)
    return [(one.fault, one.parameters) for one in found]


def world_run(world: str, number: int, last: float = 10.0) -> WorldRun:
    """The run of this number in a world. After ``last`` simulated seconds it is stopped."""
    random = Random(f"{world} {number}")
    blueprint = read(blueprint_file(world))
    lines = [*_script(random, world, last), {"at": last, "do": "stop"}]
    raw = "\n".join(map(json.dumps, lines)).encode()
    mismatch = random.choice(["hold", "adopt"])
    return WorldRun(blueprint, script_of(raw, "script", blueprint), number, mismatch, raw, world)


def _script(random: Random, world: str, last: float) -> Iterator[Json]:
    fault, given = random.choice(faults_of(world))
    if random.random() < 0.7:
        at = round(random.uniform(0.2, 0.6 * last), 2)
        # In a script ``after`` belongs to the moment of an act.
        named = {name: value for name, value in given.items() if name != "after"}
        yield {"at": at, "do": "inject", "fault": fault, **named}
    if random.random() < 0.5:
        at = round(random.uniform(0.2, 0.8 * last), 2)
        yield {"at": at, "do": "pause"}
        yield {"at": round(at + random.uniform(0.1, 1.0), 2), "do": "resume"}
    if random.random() < 0.3:
        at, branch = round(random.uniform(0.2, 0.5 * last), 2), _branch(world)
        yield {"at": at, "do": "disturb", "target": f"{branch}/0", "kind": "dropout", "rate": 0.3}


def _branch(world: str) -> str:
    return "REGISTRATION" if world == REGISTRATION else "SB1"
