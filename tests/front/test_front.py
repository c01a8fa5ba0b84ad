"""The front door: the functions that users import, and the ends of runs with faults."""

from __future__ import annotations

import os
import signal
from pathlib import Path

import pytest

import smsl_studio as smsl
from smsl_studio.blueprint.address import Address
from smsl_studio.errors import AddressError, RunRefused, SaveError, UsageError, WorldError
from smsl_studio.front import headless
from smsl_studio.front import runs as running
from smsl_studio.front.runs import Run
from smsl_studio.runlog.events import EdgeSwept, Event, OperationStarted, RunFinished
from smsl_studio.runlog.log import RunLog
from smsl_studio.shipped import samples_dir
from tests.plugin_folder import LAMP, LAMP_PLUGIN, blueprint_of, write_plugin
from tests.processes import child_processes

ONLY_ON = ("State_0/Op_break", "State_0/Op_spin")


def _sample(name: str) -> str:
    return str(samples_dir() / f"{name}.json")


def test_the_front_door_as_the_readme_has_it() -> None:
    blueprint = smsl.read(_sample("hanoi"))
    findings = [str(finding) for finding in smsl.inspect(blueprint)]
    assert (
        f"{_sample('hanoi')}:73:13 R15 SB1/State_cbb/Op_1c:"
        " moves fact 1 to b; did you mean Op_1b?" in findings
    )
    route = smsl.plan_route(blueprint["SB1"], "State_aaa", "State_ccc")
    assert route is not None
    assert len(route.operations) == 7
    assert smsl.plan_route(blueprint, "State_aaa", "SB1/State_ccc") == route
    run = smsl.run(blueprint, world="table", goal="State_ccc", seed=0)
    assert run.reason == "goal_reached"
    assert isinstance(run.events[-1], RunFinished)


def test_the_package_lists_what_it_offers() -> None:
    assert set(smsl.__all__) <= set(dir(smsl))
    for name in smsl.__all__:
        assert callable(getattr(smsl, name))
    with pytest.raises(AttributeError, match="no attribute 'reed'"):
        _ = smsl.reed


def test_in_a_branch_only_its_own_edges_are_avoided() -> None:
    branch = smsl.read(_sample("hfsm"))["SB1"]
    avoid = ["SB1/State100/Operation100B", "SB2/State0/Operation0"]
    route = smsl.plan_route(branch, "State000", "State111", avoid)
    assert route is not None
    assert route.states == ("State000", "State100", "State110", "State111")


@pytest.mark.parametrize(
    ("avoid", "states"),
    [
        ("Operation100B", ("State000", "State100", "State110", "State111")),
        ("State100/Operation100A", ("State000", "State100", "State111")),
        (Address("SB1", "State110"), ("State000", "State100", "State111")),
        ("SB1/State100", None),
        ("State000", None),
    ],
)
def test_in_a_branch_an_edge_is_avoided_however_it_is_written(
    avoid: str | Address, states: tuple[str, ...] | None
) -> None:
    branch = smsl.read(_sample("hfsm"))["SB1"]
    route = smsl.plan_route(branch, "SB1/State000", Address("SB1", "State111"), [avoid])
    assert (route.states if route else None) == states


@pytest.mark.parametrize("avoid", ["Operation100", "State100/Operation", "SB1/State9/Operation0"])
def test_what_is_no_operation_of_a_branch_is_not_avoided_in_silence(avoid: str) -> None:
    branch = smsl.read(_sample("hfsm"))["SB1"]
    with pytest.raises(AddressError, match=f"{avoid} is no operation of SB1"):
        smsl.plan_route(branch, "State000", "State111", [avoid])


def _lamp(folder: Path, **others: object) -> Run:
    if not (folder / "lamp").exists():
        write_plugin(folder, "lamp", LAMP_PLUGIN)
    return running.run(
        blueprint_of(LAMP),
        "lamp",
        avoid=ONLY_ON,
        plugin_paths=[folder],
        **others,  # type: ignore[arg-type]
    )


def test_a_run_can_be_stopped_between_two_ticks(tmp_path: Path) -> None:
    heard: list[Event] = []
    run = _lamp(
        tmp_path,
        on_event=heard.append,
        stop_when=lambda: any(isinstance(event, OperationStarted) for event in heard),
    )
    assert run.reason == "stopped"
    assert tuple(heard) == run.events
    assert [e.event for e in run.events][-2:] == ["stopped", "run_finished"]


def test_a_speed_paces_the_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    class Clock:
        now = 100.0

        def monotonic(self) -> float:
            return self.now

        def sleep(self, seconds: float) -> None:
            self.now += seconds

    clock = Clock()
    monkeypatch.setattr(headless, "time", clock)
    run = _lamp(tmp_path, speed=0.5)
    assert clock.now - 100.0 == pytest.approx(run.events[-1].t / 0.5)
    before = clock.now
    _lamp(tmp_path)
    assert clock.now == before


def test_a_child_that_is_killed_fails_the_run(tmp_path: Path) -> None:
    def kill(event: Event) -> None:
        if isinstance(event, OperationStarted):
            (child,) = child_processes()
            os.kill(child, signal.SIGKILL)

    run = _lamp(tmp_path, host="process", on_event=kill)
    assert run.reason == "failed"
    assert "was killed by signal 9 (SIGKILL)" in run.sentence
    assert run.events[-2].event == "held"
    assert child_processes() == []


def test_a_run_leaves_no_child_behind(tmp_path: Path) -> None:
    assert _lamp(tmp_path, host="process").reason == "goal_reached"
    assert child_processes() == []


def test_a_sweep_goes_on_after_a_child_has_died(tmp_path: Path) -> None:
    code = LAMP_PLUGIN.replace('raise RuntimeError("the bulb broke")', '__import__("os")._exit(3)')
    write_plugin(tmp_path, "lamp", code)
    values = {"LAMP": {**LAMP["LAMP"], "State_0": {"Op_break": "State_1", "Op_on": "State_1"}}}
    swept = list(smsl.sweep(blueprint_of(values), "lamp", host="process", plugin_paths=[tmp_path]))
    edges = [event for event in swept if isinstance(event, EdgeSwept)]
    assert [event.passed for event in edges] == [False, True, True]
    assert "ended by itself with exit status 3" in edges[0].sentence


def test_a_log_that_dies_fails_the_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write = RunLog.write

    def full(log: RunLog, events: list[Event]) -> None:
        if any(isinstance(event, OperationStarted) for event in events):
            raise SaveError("the disk is full")
        write(log, events)

    monkeypatch.setattr(RunLog, "write", full)
    run = _lamp(tmp_path, log=tmp_path / "log")
    assert (run.reason, run.sentence) == ("failed", "the disk is full")
    assert not any(isinstance(event, OperationStarted) for event in run.events)


def test_a_world_that_does_not_suit_refuses_the_run() -> None:
    blueprint = smsl.read(_sample("hfsm"))
    run = smsl.run(blueprint, world="hanoi")
    assert run.reason == "refused"
    assert "needs a blueprint of one State Branch" in run.sentence
    with pytest.raises(WorldError, match="one State Branch"):
        list(smsl.sweep(blueprint, "hanoi"))


def test_hardware_refuses_what_nobody_inspected(tmp_path: Path) -> None:
    code = LAMP_PLUGIN.replace('engine="table"', 'engine="table", hardware=True')
    write_plugin(tmp_path, "lamp", code)
    run = _lamp(tmp_path)
    assert run.reason == "refused"
    assert "hardware" in run.sentence


def test_open_run_refuses_before_anything_is_built() -> None:
    blueprint = blueprint_of({"SB1": {"State_0": {"Op": "State_9"}}})
    with pytest.raises(RunRefused, match="R02") as caught:
        smsl.open_run(blueprint)
    assert caught.value.place is not None
    for wrong in ({"host": "far"}, {"on_mismatch": "shrug"}):
        with pytest.raises(UsageError):
            smsl.open_run(smsl.read(_sample("hfsm")), **wrong)  # type: ignore[arg-type]


def test_open_run_by_hand_is_asked() -> None:
    dispatcher = smsl.open_run(smsl.read(_sample("hfsm")), host="local", automatic=False)
    try:
        dispatcher.open()
        assert dispatcher.phase == "ready"
        assert [str(p.address) for p in dispatcher.status.possible if p.permitted]
    finally:
        dispatcher.close()


def test_the_worlds_there_are() -> None:
    assert smsl.worlds()[0] == "table"
    assert "hanoi" in smsl.worlds()
