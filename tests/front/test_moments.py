"""A moment of a recorded run equals the same moment of the live one, event by event."""

from __future__ import annotations

import json
from dataclasses import dataclass, fields, is_dataclass
from pathlib import Path
from typing import Any

import pytest

import smsl_studio as smsl
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.dispatch.execution.status import DispatchStatus
from smsl_studio.dispatch.status_then import status_at
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.front.script.lines import script_of
from smsl_studio.front.script.player import ScriptPlayer
from smsl_studio.front.script.script import Script
from smsl_studio.runlog.changes import after
from smsl_studio.runlog.grammar.log_reader import read_log
from smsl_studio.runlog.log import RunLog
from smsl_studio.runlog.moment import RunMoment
from smsl_studio.runlog.playback import Playback
from smsl_studio.shipped import samples_dir

SCRIPTS = samples_dir() / "scripts"
ALWAYS = ("phase", "reason", "sentence", "details", "full_map", "by", "carrying")
BEGUN = ("configuration", "goals", "operations", "since", "previous")
"""What a live run shows of itself that its events say as well, always and once it has begun."""
SHUT = [
    json.dumps({"when": "SB1/State_caa", "do": "prune", "address": f"SB1/State_caa/{name}",
                "reason": "blocked"})
    for name in ("Op_1a", "Op_1b", "Op_2b")
]  # fmt: skip
NO_ROUTE = "\n".join(
    [
        '{"at": 0, "do": "disturb", "target": "SB1/2", "kind": "delay", "seconds": 0.01}',
        *SHUT,
        '{"at": 1, "do": "full_map", "on": true}',
        '{"at": 1, "do": "restore", "address": "SB1/State_caa/Op_1b"}',
        '{"at": 1.1, "do": "ask", "address": "SB1/State_caa/Op_1b"}',
        '{"at": 1.5, "do": "resume"}',
        '{"at": 1.6, "do": "stop", "by": "L. Brandt"}',
        '{"at": 1.7, "do": "reset", "by": "L. Brandt"}',
    ]
)


@dataclass(frozen=True)
class Case:
    """A sample, and the script under which it runs."""

    sample: str
    script: str = ""
    asked: tuple[tuple[str, Any], ...] = ()

    def __str__(self) -> str:
        return f"{self.sample}-{self.script.partition(chr(10))[0][:30] or 'alone'}"

    def acts(self, blueprint: Blueprint) -> Script | None:
        if self.script.endswith(".jsonl"):
            return smsl.read_script(SCRIPTS / self.script, blueprint)
        return script_of(self.script.encode(), "script", blueprint) if self.script else None


CASES = [
    *map(Case, ("hfsm", "registration", "hanoi-2", "hanoi-4", "three-levels", "three-roots")),
    *(
        Case("hanoi-corrected", f"hanoi-{name}.jsonl")
        for name in ("chosen", "cut", "faults", "pruned", "taken-over")
    ),
    Case("registration-people", "registration-answered.jsonl"),
    Case("hanoi-corrected", NO_ROUTE),
    Case("hanoi-2", '{"at": 0.01, "do": "stop"}'),
    Case("three-levels", '{"at": 1, "do": "stop"}', (("levels", {"supervision": "human"}),)),
]


def plain(value: Any) -> Any:
    """A value as it can be compared: times to a microsecond, as a log has them."""
    if isinstance(value, float):
        return round(value, 6)
    if is_dataclass(value):
        return {one.name: plain(getattr(value, one.name)) for one in fields(value)}
    if isinstance(value, dict):
        return {key: plain(one) for key, one in value.items()}
    return [plain(one) for one in value] if isinstance(value, tuple | list) else value


def assert_alike(blueprint: Blueprint, moment: RunMoment, now: DispatchStatus) -> None:
    """What the events say of a run is what it shows of itself."""
    then = status_at(blueprint, moment)
    for name in (*ALWAYS, *BEGUN) if moment.begun else ALWAYS:
        assert plain(getattr(then, name)) == plain(getattr(now, name)), name
    if now.phase != "taken_over":  # what giving back finds is offered, and told when it is taken
        assert plain(then.candidates) == plain(now.candidates)
    if now.running is not None:
        assert (then.running, plain(then.running_since)) == (
            now.running, plain(now.running_since),
        )  # fmt: skip
    if now.phase in ("stopped", "taken_over"):
        assert then.route == now.route == ()
    sensed = {key: one.value for key, one in now.scene.readings.items() if one.sensed}
    assert {key: one.value for key, one in then.scene.readings.items()} == sensed


def live(
    blueprint: Blueprint, dispatcher: Dispatcher, acting: ScriptPlayer | None, log: RunLog
) -> list[RunMoment]:
    """The moment after each event of a run that goes on, compared with what it shows."""
    moments = [RunMoment()]
    happened = dispatcher.open()
    while True:
        log.write(happened)
        for event in happened:
            moments.append(after(moments[-1], event))
        if acting is not None:
            acting.hear(happened)
        assert_alike(blueprint, moments[-1], dispatcher.status)
        if dispatcher.finished:
            return moments
        if acting is not None:
            acting.before(dispatcher)
        elif dispatcher.phase not in ("running", "waiting"):
            dispatcher.leave()
        happened = dispatcher.tick()


@pytest.mark.parametrize("case", CASES, ids=str)
def test_a_moment_of_a_recorded_run_equals_the_same_moment_of_the_live_one(
    case: Case, tmp_path: Path
) -> None:
    blueprint = smsl.read(samples_dir() / f"{case.sample}.json")
    script = case.acts(blueprint)
    dispatcher = smsl.open_run(blueprint, host="local", attended=True, **dict(case.asked))
    with RunLog(tmp_path / "log.jsonl", {"file": f"{case.sample}.json"}) as log:
        try:
            moments = live(blueprint, dispatcher, ScriptPlayer(script) if script else None, log)
            log.finish()
        finally:
            dispatcher.close()
    found = read_log(tmp_path / "log.jsonl", COMMANDS)
    assert found.doubt is None
    replayed = Playback(found.events)
    for index, moment in enumerate(moments):
        assert plain(replayed.at(index)) == plain(moment)
