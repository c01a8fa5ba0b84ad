"""A walk by hand: what is permitted, why the rest is refused, and the shortest run to a place."""

from __future__ import annotations

from pathlib import Path

import pytest

from smsl_studio.errors import RunRefused
from smsl_studio.front.inputs import read
from smsl_studio.inspection.explorer.onward import ConfigurationWalk, OnwardStep
from smsl_studio.inspection.explorer.run_to import RunThere, shortest_run_to
from smsl_studio.inspection.proof.engines import Engines
from tests.dispatch.generated import blueprint_values
from tests.inspection.explorer.test_explorer import blueprint, coupled_steps, reached
from tests.inspection.proof.brute import Brute, starts_of

SAMPLES = Path(__file__).parents[3] / "samples"


@pytest.mark.parametrize("seed", range(20))
def test_plain_steps_and_a_plain_search_permit_and_find_the_same(seed: int) -> None:
    plain = blueprint_values(seed)
    whole = blueprint(plain)
    starts = starts_of(lambda: ConfigurationWalk(whole).start(), whole)
    if not starts:
        return
    (start,) = starts
    steps, walk = coupled_steps(Brute(plain, start)), ConfigurationWalk(whole)
    assert walk.start() == start
    ways = reached(start, steps)
    for key, way in list(ways.items())[:: max(len(ways) // 12, 1)]:
        here = dict(key)
        wanted = dict(steps(here))
        found = walk.steps(here)
        permitted = [one for one in found if one.permitted]
        assert {str(one.address): {**here, **one.after} for one in permitted} == wanted
        assert {one.address for one in found} == {
            address for name in plain for address in out(plain, name, here[name])
        }
        assert all(one.reasons for one in found if not one.permitted)
        run = shortest_run_to(whole, here, 100_000).run
        assert run is not None
        assert tuple(map(str, run.path)) == way
        assert (dict(run.start), dict(run.end)) == (start, here)
    for key, way in list(ways.items())[:: max(len(ways) // 3, 1)]:
        together = shortest_run_to(whole, dict(key), 1)
        assert together.run is not None, "all configurations are looked at together"
        assert tuple(map(str, together.run.path)) == way


def out(plain: dict[str, dict[str, dict[str, str]]], name: str, state: str) -> set[object]:
    from smsl_studio.blueprint.address import Address

    return {Address(name, state, operation) for operation in plain[name][state]}


def test_a_place_that_no_run_reaches_and_one_beyond_the_limit(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    free = {name: {
        "HEADER": {"INITIAL": "S0", "ACTIVATING": "S9"},
        **{f"S{n}": {"on": f"S{n + 1}"} for n in range(9)}, "S9": {}, "Salone": {},
    } for name in ("A", "B")}  # fmt: skip
    whole = blueprint(free)
    assert shortest_run_to(whole, {"A": "Salone", "B": "S0"}, 1000).run is None
    assert shortest_run_to(whole, {"A": "Salone", "B": "S0"}, 1000).bound == ""
    beyond = shortest_run_to(whole, {"A": "S9", "B": "S1"}, 5).run
    assert beyond is not None
    assert len(beyond.path) == 10, "what is not stored is looked at together"
    assert shortest_run_to(whole, {"A": "Salone", "B": "S0"}, 5) == RunThere(None)
    monkeypatch.setattr(Engines, "engine", lambda *_: None)
    bounded = shortest_run_to(whole, {"A": "S9", "B": "S1"}, 5)
    assert bounded == RunThere(None, "5 configurations")
    found = shortest_run_to(whole, {"A": "S2", "B": "S1"}, 5).run
    assert found is not None
    assert [str(one) for one in found.path] == ["A/S0/on", "A/S1/on", "B/S0/on"]


def walk_of(name: str) -> tuple[ConfigurationWalk, dict[str, str]]:
    walk = ConfigurationWalk(read(SAMPLES / name))
    return walk, walk.start()


def the(steps: tuple[OnwardStep, ...], address: str) -> OnwardStep:
    (found,) = [one for one in steps if str(one.address) == address]
    return found


def test_a_refusal_names_facts_in_plain_words() -> None:
    walk, start = walk_of("registration-digitization.json")
    crossing = the(walk.steps(start), "DIGITIZATION/State0/DigitizeAllLandmarks")
    assert crossing.reasons == (
        "it reaches State1, the ACTIVATING state of DIGITIZATION, and REGISTRATION has no "
        "operation out of State000 that changes REGISTRATION/Landmarks digitized alone",
    )
    values = {
        "A": {"HEADER": {"INITIAL": "S_0", "ACTIVATING": "S_1"}, "_facts": {"0": {"name": "shut"}},
              "S_0": {"shut": "S_1"}, "S_1": {}},
        "B": {"HEADER": {"INITIAL": "S_0", "ACTIVATING": "S_1"},
              "_operations": {"go": {"requires": {"A/0": "1"}}}, "S_0": {"go": "S_1"}, "S_1": {}},
    }  # fmt: skip
    walk = ConfigurationWalk(blueprint(values))
    refused = the(walk.steps(walk.start()), "B/S_0/go")
    assert refused.reasons == ("it requires A/shut to be 1, and it is 0",)
    assert the(walk.steps({"A": "S_1", "B": "S_0"}), "B/S_0/go").permitted


def test_a_step_into_a_hazard_is_permitted_and_says_so() -> None:
    two = {"HEADER": {"INITIAL": "S_0", "ACTIVATING": "S_1"}, "S_0": {"on": "S_1"}, "S_1": {}}
    hazard = {"name": "Both", "facts": {"A/0": "1", "B/0": "1"}}
    walk = ConfigurationWalk(blueprint({"_hazards": [hazard], "A": two, "B": two}))
    assert [one.hazard for one in walk.steps(walk.start())] == ["", ""]
    (step,) = walk.steps({"A": "S_1", "B": "S_0"})
    assert step.permitted
    assert step.hazard == "Both"


def test_sub_sbs_follow_the_place_that_is_wanted_and_others_stay() -> None:
    walk, start = walk_of("registration-digitization.json")
    assert walk.placed({"REGISTRATION": "State110"}, start) == {
        "REGISTRATION": "State110", "DIGITIZATION": "State1"
    }  # fmt: skip
    there = {"REGISTRATION": "State111", "DIGITIZATION": "State1"}
    assert walk.placed({"REGISTRATION": "State100"}, there) == {
        "REGISTRATION": "State100", "DIGITIZATION": "State0"
    }  # fmt: skip
    with pytest.raises(RunRefused, match="disagrees with REGISTRATION/State000"):
        walk.placed({"DIGITIZATION": "State1"}, start)
    both = {"REGISTRATION": "State110", "DIGITIZATION": "State0"}
    with pytest.raises(RunRefused, match="disagrees"):
        walk.placed(both, start)
