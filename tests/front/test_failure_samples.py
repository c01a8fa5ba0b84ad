"""The samples with failure states, in the table world: in by a fault, out by a recovery."""

from __future__ import annotations

import pytest

import smsl_studio as smsl
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.hosts import known_world
from smsl_studio.front.runs import open_run
from smsl_studio.front.script.fit import check_faults
from smsl_studio.inspection.rules.finding import Severity
from smsl_studio.runlog.events import Event, OperationStarted, Relocalised, RunFinished
from smsl_studio.shipped import samples_dir


def _sample(name: str) -> Blueprint:
    return smsl.read(samples_dir() / f"{name}.json")


def _run_into(blueprint: Blueprint, operation: str, state: str, mode: str) -> list[Event]:
    """A run in which one operation, when it begins, ends in another state than it should."""
    dispatcher = open_run(blueprint, "table", host="local", on_mismatch=mode)
    events = list(dispatcher.open())
    done = False
    while not dispatcher.finished:
        planned = dispatcher.status.configuration
        here = next(iter(planned.values()))
        if not done and operation in blueprint[next(iter(planned))].table[here]:
            dispatcher.inject("elsewhere", state=state)
            done = True
        events += dispatcher.tick()
    dispatcher.close()
    return events


def _operations(events: list[Event]) -> list[str]:
    return [e.address.rpartition("/")[2] for e in events if isinstance(e, OperationStarted)]


@pytest.mark.parametrize(
    ("operation", "state", "way"),
    [
        ("Op_DigitizeLandmarks", "State_1e0", ["Op_RecoverPoint", "Op_Register"]),
        ("Op_Register", "State_11e", ["Op_RecoverRegistration"]),
        ("Op_Register", "State_1ee", ["Op_DiscardPoints", "Op_DigitizeLandmarks", "Op_Register"]),
    ],
)
def test_registration_recovers_from_each_of_its_failures(
    operation: str, state: str, way: list[str]
) -> None:
    blueprint = _sample("registration-failures")
    events = _run_into(blueprint, operation, state, "adopt")
    done = _operations(events)
    after = done[done.index(operation) + 1 :]
    last = events[-1]
    assert isinstance(last, RunFinished)
    if "Op_Register" in way and operation == "Op_Register":
        # The operation that failed is risky, and nothing else registers: a person decides.
        assert (last.reason, after) == ("held", way[: len(after)])
    else:
        assert (last.reason, after) == ("goal_reached", way)
    adopted = [e.configuration["REGISTRATION"] for e in events if isinstance(e, Relocalised)]
    assert adopted == [state]


@pytest.mark.parametrize("state", ["State_1e0", "State_11e", "State_1ee"])
def test_without_being_asked_to_adopt_the_run_holds(state: str) -> None:
    events = _run_into(_sample("registration-failures"), "Op_Register", state, "hold")
    last = events[-1]
    assert isinstance(last, RunFinished)
    assert (last.reason, last.configuration) == ("held", {"REGISTRATION": "State_110"})


def test_every_failure_state_of_hanoi_leads_to_the_goal() -> None:
    blueprint = _sample("hanoi-failures")
    branch = blueprint["SB1"]
    lost = [state for state in branch.table if set("hx") & set(branch.facts(state))]
    assert len(lost) == 54
    for state in lost:
        done = smsl.run(blueprint, start=f"SB1/{state}")
        assert done.reason == "goal_reached", state
        first = next(e for e in done.events if isinstance(e, OperationStarted))
        assert "Op_recover" in first.address


@pytest.mark.parametrize("name", ["hanoi-failures", "registration-failures"])
def test_inspection_only_says_that_failures_come_from_outside(name: str) -> None:
    blueprint = _sample(name)
    found = [one for one in smsl.inspect(blueprint) if one.severity is not Severity.NOTE]
    assert {(one.rule, one.severity) for one in found} == {("R10", Severity.WARNING)}
    assert all("entered from outside" in one.message for one in found)


def test_the_script_for_the_failures_fits_the_world_with_the_robot() -> None:
    """Every sample script reads; this one names faults that only the world ``hanoi`` has."""
    file = samples_dir() / "scripts" / "hanoi-dropped.jsonl"
    script = smsl.read_script(file, _sample("hanoi-failures"))
    loaded = known_world("hanoi")
    assert loaded is not None
    check_faults(script, "hanoi", loaded.faults_of("hanoi"))
    assert [act.given["fault"] for act in script.acts] == ["gripper_opens", "blocked_peg"]
