"""What a plot of a fact's sources shows."""

from __future__ import annotations

import json
from math import isnan
from pathlib import Path

import pytest

from smsl_studio import front
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.views.measure_traces import MeasureTrace, measured_of, traces_of
from smsl_studio.runlog.events import FactChanged, Measured
from smsl_studio.runlog.playback import RunObserver

FACT = ("SB", 0)
ENTRY = {
    "sources": {"force": "N", "tip": "m"},
    "max_age": 20,
    "predicate": {
        "0": "force < 500 mN or age(tip) > 2 s",
        "1": "abs(force) > 2 N and distance(tip, tip) < 5 mm",
    },
}


@pytest.fixture
def blueprint(tmp_path: Path) -> Blueprint:
    file = tmp_path / "clamp.json"
    facts = {"0": ENTRY, "1": {"sources": {"x": "N"}, "predicate": {"0": "x < 1 mm"}}}
    table = {"State_00": {"Go": "State_10"}, "State_10": {}}
    file.write_text(json.dumps({"SB": {"_facts": facts, **table}}), encoding="utf-8")
    return front.read(file)


def measured(t: float, source: str, value: str | None, quality: str = "good") -> Measured:
    return Measured(t=t, branch="SB", digit=0, source=source, value=value, quality=quality, taken=t)


def traces(blueprint: Blueprint, *events: Measured, now: float = 40.0) -> tuple[MeasureTrace, ...]:
    told = RunObserver()
    told.tell(events)
    return traces_of(blueprint, FACT, told.story.history, now)


def test_thresholds_are_in_the_unit_of_the_source(blueprint: Blueprint) -> None:
    force, tip = traces(blueprint)
    assert [(one.at, one.words) for one in force.thresholds] == [
        (0.5, "0 if < 500 mN"), (2.0, "1 if > 2 N"), (-2.0, "1 if > 2 N")]  # fmt: skip
    assert tip.thresholds == ()
    assert (force.unit, len(force.lines), len(tip.lines)) == ("N", 1, 3)


def test_only_the_last_30_s_count_and_what_is_no_measure_breaks_the_line(
    blueprint: Blueprint,
) -> None:
    events = [measured(9.9, "force", "1.0"), measured(10.0, "force", "1.5"),
              measured(20.0, "force", "9.0", "uncertain"), measured(30.0, "force", "2.5"),
              measured(30.0, "tip", "0.1 0.2 0.3"), measured(39.0, "tip", None, "bad")]  # fmt: skip
    force, tip = traces(blueprint, *events)
    assert force.times == (10.0, 20.0, 30.0)
    (line,) = force.lines
    assert (line[0], isnan(line[1]), line[2]) == (1.5, True, 2.5)
    assert force.newest == "2.5 N"
    assert [axis[0] for axis in tip.lines] == [0.1, 0.2, 0.3]
    assert tip.newest == "its reading is bad"


def test_a_measure_stays_for_its_age_and_then_nothing_is_measured(blueprint: Blueprint) -> None:
    force, _ = traces(blueprint, measured(15.0, "force", "1.5"))
    assert force.times == (15.0, 35.0)
    assert isnan(force.lines[0][1])
    assert force.newest == "no reading for 25.0 s"


def test_a_recorded_run_is_plotted_at_any_moment(blueprint: Blueprint) -> None:
    told = RunObserver()
    told.tell([measured(1.0, "force", "1.5"), FactChanged(t=1.0, branch="SB", digit=0, value="0"),
               measured(5.0, "force", "2.5"), FactChanged(t=5.0, branch="SB", digit=0, value="1"),
               measured(9.0, "force", "3.5")])  # fmt: skip
    found = measured_of(blueprint, FACT, told.story.history, 6.0)
    assert found is not None
    assert found.traces[0].times == (1.0, 5.0)
    assert found.values == ((1.0, 5.0, "0"), (5.0, 6.0, "1"))
    assert found.notation[0] == "f_1 = λs. F(sense(force, tip, s))"
    assert measured_of(blueprint, ("SB", 1), told.story.history, 6.0) is None


def test_without_predicates_that_decide_there_is_nothing(blueprint: Blueprint) -> None:
    history = RunObserver().story.history
    assert traces_of(blueprint, ("SB", 1), history, 0.0) == ()
    assert traces_of(blueprint, ("SB", 7), history, 0.0) == ()
    assert traces_of(blueprint, ("TB", 0), history, 0.0) == ()
