"""An operation that runs another blueprint: one level down, with its own events, stop and hold."""

from __future__ import annotations

import json
import subprocess
import sys
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import smsl_studio as smsl
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.errors import RunRefused
from smsl_studio.front.bundles import bundled
from smsl_studio.front.logs import verify_stream
from smsl_studio.front.verifier import told_again
from smsl_studio.inspection.inspect import inspect
from smsl_studio.runlog.events import (
    Committed,
    Event,
    Held,
    OperationRisky,
    Paused,
    RunFinished,
    Within,
)
from smsl_studio.seal.chain import Chain
from smsl_studio.shipped import samples_dir

Json = Any
TOWER = samples_dir() / "hanoi-tower.json"


def inner(events: list[Event]) -> list[Json]:
    """What the procedures have told."""
    return [json.loads(one.told) for one in events if isinstance(one, Within)]


def until(run: Dispatcher, wanted: Callable[[list[Event]], bool]) -> list[Event]:
    """Tick a run until its events are as wanted, or it is over."""
    events: list[Event] = []
    for _ in range(20_000):
        if run.finished or wanted(events):
            return events
        events += run.tick()
    raise AssertionError("the run does not come to this point")


def opened(file: Path = TOWER, world: str = "table", **more: Any) -> Dispatcher:
    """Open an attended run."""
    run = smsl.open_run(smsl.read(file), world, host="local", attended=True, **more)
    assert run.open()[0].event == "run_started"
    return run


def written(folder: Path, **changes: Any) -> Path:
    """The sample with other operations, beside a copy of what it runs."""
    values = json.loads(TOWER.read_text("utf-8"))
    values["TOWER"]["_operations"] |= changes
    (folder / "hanoi-2.json").write_bytes((samples_dir() / "hanoi-2.json").read_bytes())
    path = folder / "tower.json"
    path.write_text(json.dumps(values), "utf-8")
    return path


def test_it_runs_to_its_goal_and_tells_its_own_events() -> None:
    done = smsl.run(smsl.read(TOWER))
    assert done.reason == "goal_reached"
    own = [one for one in done.events if isinstance(one, Committed)]
    assert [one.operations[0].rpartition("/")[2] for one in own] == [
        "TowerToB",
        "Op_3c",
        "TowerToC",
    ]
    told = inner(list(done.events))
    starts = [one["start"] for one in told if one["event"] == "run_started"]
    assert starts == [{"SB1": "State_aa"}, {"SB1": "State_bb"}], "it goes on where it stands"
    ends = [(one["reason"], one["operations"]) for one in told if one["event"] == "run_finished"]
    assert ends == [("goal_reached", 3), ("goal_reached", 3)]
    times = [one.t for one in done.events]
    assert times == sorted(times)


def test_a_pause_and_a_stop_reach_into_it() -> None:
    run = opened()
    events = until(run, lambda told: len(inner(told)) > 8)
    run.pause(by="Ada")
    events += run.tick()
    time = run.time
    assert run.phase == "paused"
    for _ in range(5):
        events += run.tick()
    assert run.time == time
    run.resume(by="Ada")
    events += until(run, lambda told: len(inner(told)) > 2)
    run.stop(by="Ada")
    events += run.tick()
    assert inner(events)[-1]["event"] == "run_finished"
    assert inner(events)[-1]["reason"] == "stopped"
    assert run.phase == "stopped"
    run.close()


def test_a_hold_in_its_middle_is_told_and_a_person_resumes_it() -> None:
    run = opened()
    until(run, lambda told: len(inner(told)) > 8)
    run.disturb("SB1/0", "stuck", value="a", by="Ada")
    events = until(run, lambda told: isinstance(told[-1] if told else None, Paused))
    (held,) = [one for one in inner(events) if one["event"] == "held"]
    assert run.phase == "paused"
    assert run.status.sentence == held["reason"]
    assert not [one for one in events if isinstance(one, Held)], "the run above only waits"
    run.disturb("SB1/0", "none", by="Ada")
    run.resume(by="Ada")
    events = until(run, lambda told: isinstance(told[-1] if told else None, Paused))
    assert inner(events)[-1]["event"] == "held", "the scene has changed: it is shown once more"
    run.resume(by="Ada")
    events += until(run, lambda told: isinstance(told[-1] if told else None, Paused))
    assert isinstance(events[-1], RunFinished), inner(events)[-1]
    assert events[-1].reason == "goal_reached"
    words = [one["event"] for one in inner(events)]
    assert words.index("commanded") < words.index("resumed") < words.index("goal_reached")
    run.close()


def test_without_a_person_its_hold_fails_the_operation() -> None:
    run = smsl.open_run(smsl.read(TOWER), host="local")
    events = [*run.open()]
    while not any(one["event"] == "committed" for one in inner(events)):
        events += run.tick()
    run.disturb("SB1/0", "stuck", value="a", by="Ada")
    events += until(run, lambda told: False)
    end = events[-1]
    assert isinstance(end, RunFinished)
    assert end.reason == "held"
    told = inner(events)[-1]
    assert (told["event"], told["reason"]) == ("run_finished", "held")
    reasons = [one.reason for one in events if isinstance(one, OperationRisky)]
    assert any(told["sentence"] in one for one in reasons), "why it failed is told above, too"
    run.close()


@pytest.mark.parametrize(
    ("binding", "words"),
    [
        ({"blueprint": "none.json", "goal": "SB1/State_bb"}, "cannot be read"),
        ({"blueprint": "tower.json", "goal": "TOWER/State_ccc"}, "lead"),
        ({"blueprint": "hanoi-2.json", "goal": "SB1/State_zz"}, "goal"),
        ({"blueprint": "hanoi-2.json", "goal": "State_bb"}, "is no state"),
        ({"blueprint": "../out.json", "goal": "SB1/State_bb"}, "leads out of the project"),
        ({"blueprint": f"store:{64 * '0'}", "goal": "SB1/State_bb"}, "not in the store"),
    ],
)
def test_what_cannot_be_run_is_an_error_and_refuses(
    tmp_path: Path, binding: Json, words: str
) -> None:
    blueprint = smsl.read(written(tmp_path, TowerToB={"binding": binding}))
    (found,) = inspect(blueprint, ["R08"])
    assert words in found.message
    assert smsl.run(blueprint).reason == "refused"


def test_it_goes_one_level_down_only(tmp_path: Path) -> None:
    file = written(tmp_path)
    outer = {
        "OUT": {
            "_operations": {
                "go": {"binding": {"blueprint": "tower.json", "goal": "TOWER/State_ccc"}}
            },
            "State_0": {"go": "State_1"},
            "State_1": {},
        }
    }
    file.with_name("outer.json").write_text(json.dumps(outer), "utf-8")
    (found,) = inspect(smsl.read(file.with_name("outer.json")), ["R08"])
    assert "one level down only" in found.message
    with pytest.raises(RunRefused):
        smsl.open_run(smsl.read(file.with_name("outer.json")), host="local")


def forged(raw: bytes, change: Callable[[list[Json]], None]) -> bytes:
    """A log whose lines were changed, with a chain and a head that fit."""
    *lines, _ = [json.loads(line) for line in raw.splitlines()]
    for line in lines:
        line.pop("chain", None)
    change(lines)
    chain = Chain()
    told = [chain.linked(json.dumps(one, separators=(",", ":")).encode()) for one in lines]
    head = {"head": {"count": len(told) - 1, "hash": chain.digest}}
    return b"".join((*told, json.dumps(head, separators=(",", ":")).encode(), b"\n"))


def _told(lines: list[Json], event: str) -> int:
    return next(
        at for at, one in enumerate(lines) if one.get("told", "").startswith(f'{{"event":"{event}"')
    )


def _no_goal(lines: list[Json]) -> None:
    del lines[_told(lines, "goal_reached") : _told(lines, "run_finished") + 1]


def _other_target(lines: list[Json]) -> None:
    at = _told(lines, "operation_started")
    lines[at]["told"] = lines[at]["told"].replace('"target":"State_', '"target":"State_x')


def _unseen(lines: list[Json]) -> None:
    del lines[_told(lines, "state_checked") + 3 :][:0]
    del lines[_told(lines, "operation_ended")]


def _elsewhere(lines: list[Json]) -> None:
    lines.insert(3, lines[_told(lines, "committed")])


def _another_operation(lines: list[Json]) -> None:
    lines[_told(lines, "committed")]["operation"] = "TOWER/State_bba/Op_3c"


def _another_time(lines: list[Json]) -> None:
    at = _told(lines, "run_finished")
    event = json.loads(lines[at]["told"])
    lines[at]["told"] = json.dumps({**event, "t": event["t"] + 0.001}, separators=(",", ":"))


def _another_space(lines: list[Json]) -> None:
    at = _told(lines, "committed")
    lines[at]["told"] = lines[at]["told"].replace('"operations":[', '"operations": [')


def test_a_log_of_it_is_believed_and_impossible_ones_are_not(tmp_path: Path) -> None:
    blueprint, log = smsl.read(TOWER), tmp_path / "run.jsonl"
    smsl.run(blueprint, log=log)
    raw = log.read_bytes()
    assert forged(raw, lambda lines: None) == raw
    assert told_again(raw, blueprint) == ""
    assert verified(tmp_path, raw)
    changes = (_no_goal, _other_target, _unseen, _elsewhere, _another_operation, _another_time)
    for change in (*changes, _another_space):
        wrong = forged(raw, change)
        assert told_again(wrong, blueprint), change.__name__
        assert not verified(tmp_path, wrong), change.__name__


def verified(folder: Path, raw: bytes) -> bool:
    """Whether ``replay --verify`` believes a log."""
    file = folder / "again.jsonl"
    file.write_bytes(raw)
    with file.open("rb") as stream:
        return not verify_stream(stream, str(file)).doubt


def _another_digest(lines: list[Json]) -> None:
    lines[0]["procedures"] = {"hanoi-2.json": "0" * 64}


def _no_digest(lines: list[Json]) -> None:
    del lines[0]["procedures"]


def _larger_one(lines: list[Json]) -> None:
    lines[0]["procedures"] = {"hanoi-2.json": lines[0]["digests"]["closure"]}


def test_the_header_names_what_was_run(tmp_path: Path) -> None:
    blueprint, log = smsl.read(TOWER), tmp_path / "run.jsonl"
    smsl.run(blueprint, log=log)
    for change in (_another_digest, _no_digest, _larger_one):
        assert told_again(forged(log.read_bytes(), change), blueprint), change.__name__
    odd = forged(log.read_bytes(), lambda lines: lines[0].update(procedures=[1]))
    assert not verified(tmp_path, odd)


ACTS = {
    "held": '{"at": 2.4, "do": "inject", "fault": "gripper_opens"}\n{"at": 6, "do": "resume"}\n',
    "stopped": '{"at": 2, "do": "stop"}\n{"at": 3, "do": "reset"}\n{"at": 4, "do": "resume"}\n',
    "cut": '{"at": 2, "do": "stop"}\n',
}


@pytest.mark.parametrize("acts", ACTS.values(), ids=ACTS)
def test_a_log_of_what_people_do_in_its_middle_is_believed(acts: str, tmp_path: Path) -> None:
    blueprint, log = smsl.read(TOWER), tmp_path / "run.jsonl"
    (tmp_path / "acts").write_text(acts)
    script = smsl.read_script(tmp_path / "acts", blueprint)
    events = smsl.run(blueprint, "hanoi", script=script, log=log).events
    words = [one["event"] for one in inner(list(events))]
    assert words[-1] == "run_finished"
    assert ("held" in words) == ("resume" in acts and "stop" not in acts)
    if "held" in words:
        assert words.index("held") < words.index("relocalised") < words.index("goal_reached")
        assert isinstance(events[-1], RunFinished)
        assert events[-1].reason == "goal_reached"
    assert told_again(log.read_bytes(), blueprint) == ""
    assert verified(tmp_path, log.read_bytes())


def test_a_bundle_holds_what_it_runs_and_is_checked(tmp_path: Path) -> None:
    log = tmp_path / "run.jsonl"
    smsl.run(smsl.read(TOWER), log=log)
    (tmp_path / "out.zip").write_bytes(bundled(smsl.read(TOWER), "out.zip", [str(log)]))
    with zipfile.ZipFile(tmp_path / "out.zip") as archive:
        archive.extractall(tmp_path)
    assert checked(tmp_path) == 0
    (tmp_path / "content/hanoi-2.json").rename(tmp_path / "elsewhere")
    assert checked(tmp_path) == 1, "what was run is missing"
    (tmp_path / "elsewhere").rename(tmp_path / "content/hanoi-2.json")
    file = tmp_path / "blueprint/hanoi-2.json"
    file.write_bytes(file.read_bytes() + b" ")
    assert checked(tmp_path) == 1, "its file is another"


def checked(folder: Path) -> int:
    """The exit status of ``verify.py`` in a bare Python."""
    command = [sys.executable, "-S", "-I", "verify.py"]
    return subprocess.run(command, cwd=folder, capture_output=True, check=False).returncode


def test_in_physics_it_moves_the_same_disks_and_is_held_and_resumed() -> None:
    run = opened(world="hanoi")
    events = until(run, lambda told: any(one["event"] == "committed" for one in inner(told)))
    run.pause(by="Ada")
    events += run.tick()
    assert run.phase == "paused"
    run.disturb("SB1/0", "dropout", by="Ada")
    run.resume(by="Ada")
    events += until(run, lambda told: isinstance(told[-1] if told else None, Paused))
    assert inner(events)[-1]["event"] == "held", "a fact of the procedure is unknown"
    run.disturb("SB1/0", "none", by="Ada")
    for _ in range(4):
        run.resume(by="Ada")
        events += until(run, lambda told: isinstance(told[-1] if told else None, Paused))
        if run.finished:
            break
    assert isinstance(events[-1], RunFinished)
    assert events[-1].reason == "goal_reached"
    run.close()
