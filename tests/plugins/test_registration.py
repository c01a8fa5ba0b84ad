"""Registration in physics: the default route really registers, and nothing false is said."""

from __future__ import annotations

import numpy as np
import pytest

import smsl_studio as smsl
from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.front.sweeps import sweep
from smsl_studio.runlog.events import (
    CostsChanged,
    EdgeSwept,
    FactChanged,
    Held,
    OperationRefused,
    RunFinished,
)
from smsl_studio.shipped import samples_dir
from tests.plugin_folder import LAMP, blueprint_of
from tests.plugins.site_runs import FLAT, LIMIT, SUBBED, SiteFault, run_site, site_faults


@pytest.mark.parametrize(("file", "seed"), [(FLAT, 0), (SUBBED, 7)])
def test_the_default_route_plans_touches_and_fits(file: str, seed: int) -> None:
    story = run_site(file, seed=seed)
    assert story.end.reason == "goal_reached"
    assert story.error < LIMIT
    assert not [name for name in story.started if name.startswith(("Op_UsePrev", "UsePrev"))]


@pytest.mark.parametrize(("file", "each"), [(FLAT, 4), (SUBBED, 1)])
def test_edges_pass_alone(file: str, each: int) -> None:
    """Each fourth edge of the flat file; the bench ``worlds`` tries all. Those that use a saved
    registration find one, whose reference has not moved. Of the other file all are tried, because
    an edge of it may need others to bring its sub where it begins."""
    whole = smsl.read(samples_dir() / file)
    every = [edge.address for edge in whole["REGISTRATION"].edges()]
    others = [edge for at, edge in enumerate(every) if at % each]
    swept = sweep(editing.delete(whole, others), "registration")
    edges = [one for one in swept if isinstance(one, EdgeSwept)]
    assert len(edges) >= len(every) // each
    assert [one.address for one in edges if not one.passed] == []


def test_without_a_saved_registration_nobody_can_use_one() -> None:
    story = run_site()
    told = next(event for event in story.events if isinstance(event, CostsChanged))
    assert set(told.closed.values()) == {"no registration was saved"}
    assert len(told.closed) == 8


def test_a_saved_registration_is_used_until_the_reference_is_bumped() -> None:
    dispatcher = smsl.open_run(
        smsl.read(samples_dir() / FLAT), "registration", host="local", automatic=False
    )
    list(dispatcher.open())

    def do(name: str) -> str:
        """Ask for an operation, and return why it was refused."""
        state = dispatcher.standing.configuration["REGISTRATION"]
        dispatcher.ask(Address("REGISTRATION", state, name))
        events = list(dispatcher.tick())
        while dispatcher.phase == "running":
            events += dispatcher.tick()
        return next((e.reasons[0] for e in events if isinstance(e, OperationRefused)), "")

    try:
        dispatcher.tick()
        assert "no registration was saved" in do("Op_UsePrevReg")
        for name in ("Op_PlanLandmarks", "Op_DigitizeLandmarks", "Op_Register", "Op_ClearReg"):
            assert do(name) == ""
        assert do("Op_UsePrevReg") == ""
        assert dispatcher.standing.configuration["REGISTRATION"] == "State_1101"
        assert do("Op_ClearLandmarks") == ""
        dispatcher.inject("reference_bumped", by="a test", millimetres=3.0)
        assert "the reference has moved by 3.0 mm since it was saved" in do("Op_UsePrevReg")
    finally:
        dispatcher.close()


def test_the_planned_landmarks_are_seen_on_the_phantom_until_they_are_cleared() -> None:
    dispatcher = smsl.open_run(
        smsl.read(samples_dir() / FLAT), "registration", host="local", automatic=False
    )
    list(dispatcher.open())

    def seen() -> list[float]:
        """Return how far (mm) the five balls are from the middle of the phantom."""
        assert dispatcher.opened is not None
        names = [shape.name for shape in dispatcher.opened.shapes]
        poses = dispatcher.host.poses()
        wanted = ("phantom", *(f"landmark {number}" for number in range(1, 6)))
        middle, *balls = (np.array(poses[7 * i : 7 * i + 3]) for i in map(names.index, wanted))
        return [round(1000 * float(np.linalg.norm(ball - middle)), 6) for ball in balls]

    def do(state: str, name: str) -> None:
        dispatcher.ask(Address("REGISTRATION", state, name))
        dispatcher.tick()
        while dispatcher.phase == "running":
            dispatcher.tick()

    try:
        dispatcher.tick()
        assert seen() == [0.0] * 5
        do("State_0000", "Op_PlanLandmarks")
        assert seen() == [80.0] * 5
        do("State_1000", "Op_ClearLandmarks")
        assert seen() == [0.0] * 5
    finally:
        dispatcher.close()


def test_what_the_tracker_cannot_see_is_unknown_and_holds_until_it_is_seen_again() -> None:
    """The tracker is covered just before the landmarks count as measured."""
    dispatcher = smsl.open_run(
        smsl.read(samples_dir() / FLAT), "registration", host="local", attended=True
    )
    events = list(dispatcher.open())
    try:
        while dispatcher.time < 42.2:
            events += dispatcher.tick()
        dispatcher.inject("occluded", by="a test", seconds=3.0)
        while dispatcher.time < 45.5:
            events += dispatcher.tick()
        unknown = {e.digit for e in events if isinstance(e, FactChanged) and e.value is None}
        assert unknown == {1, 3}
        assert dispatcher.phase == "fault_hold"
        held = next(event for event in events if isinstance(event, Held))
        assert "is unknown, no valid reading" in held.reason
        dispatcher.resume(by="a test")
        events += dispatcher.tick()
        dispatcher.adopt(by="a test")
        while dispatcher.time < 60.0 and not dispatcher.finished:
            events += dispatcher.tick()
    finally:
        dispatcher.close()
    assert isinstance(events[-1], RunFinished)
    assert events[-1].reason == "goal_reached"


def test_a_pointer_waits_for_the_tracker() -> None:
    story = run_site(fault=SiteFault("occluded", 4.0, {"seconds": 10.0}))
    assert story.end.reason == "goal_reached"
    assert story.end.t > run_site().end.t + 5.0


@pytest.mark.parametrize("fault", site_faults()[::4], ids=str)
def test_no_fault_makes_a_false_registration(fault: SiteFault) -> None:
    story = run_site(fault=fault)
    assert not story.false_goal


def test_the_same_seed_gives_the_same_events() -> None:
    one, other = run_site(seed=3), run_site(seed=3)
    assert one.events == other.events
    assert run_site(seed=4).events != one.events


def test_another_blueprint_is_refused_with_a_reason() -> None:
    refused = smsl.run(blueprint_of(LAMP), "registration", host="local")
    assert "needs one root with 3 or 4 facts" in refused.sentence


def test_a_start_that_cannot_be_is_refused_with_a_reason() -> None:
    table = {"State_0001": {"go": "State_1111"}, "State_1111": {}}
    values = {"R": {"HEADER": {"ACTIVATING": "State_1111"}, **table}}
    refused = smsl.run(blueprint_of(values), "registration", host="local")
    assert "a registration needs planned and digitized landmarks" in refused.sentence
