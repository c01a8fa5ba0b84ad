"""Verdicts and shortest runs: against brute force, and by hand."""

from __future__ import annotations

import json
from collections.abc import Sequence
from random import Random
from typing import Any

import pytest

import smsl_studio as smsl
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy, start_configuration
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.blueprint.stepper import Stepper
from smsl_studio.blueprint.terms import Terms
from smsl_studio.errors import RunRefused
from smsl_studio.front.proof import prove
from smsl_studio.inspection.proof.prove import Scope
from smsl_studio.inspection.proof.prove import prove as proved
from smsl_studio.inspection.proof.verdict import Counterexample, PropertyVerdict
from smsl_studio.runlog.events import Committed
from smsl_studio.smsl.json_form import parse_json
from tests.counts import share_of
from tests.dispatch.generated import blueprint_values
from tests.inspection.proof.brute import Brute, Hit, drawn_condition


def blueprint(values: dict[str, Any]) -> Blueprint:
    return read_blueprint(parse_json(json.dumps(values, indent=1), "file.json"))


def verdicts(values: dict[str, Any], limit: int = 100_000) -> dict[str, PropertyVerdict]:
    return {one.name: one for one in prove(blueprint(values), limit).verdicts}


def asked(brute: Brute, kind: str, first: Hit, second: Hit, within: int | None) -> int | None:
    """The length of the shortest run that shows that a property fails, None if it holds."""
    if kind == "never":
        return brute.reached(first)
    if kind == "reachable":
        return 0 if brute.reached(first) is None else None
    if kind == "way_back":
        return brute.no_way_back(first, second, within)
    return (brute.before if kind == "before" else brute.after)(first, second)


def carried_out(whole: Blueprint, run: Counterexample) -> None:
    """Carry out a run by the dispatcher's own steps; it must end where it says."""
    stepper = Stepper(Hierarchy(whole), Terms(failing=None))
    here = dict(run.start)
    assert here == start_configuration(Hierarchy(whole), {})
    for number, address in enumerate(run.path):
        edges = stepper.edges.out(address.branch, here[address.branch])
        (edge,) = [one for one in edges if one.address == address]
        step = stepper.step(here, edge)
        assert isinstance(step, JointStep)
        if run.during is not None and number == len(run.path) - 1:
            passed = dict(here)
            seen = []
            for action in step.actions:
                seen.append((action.edge.address, dict(passed)))
                passed.update(action.moved)
            assert (run.during, run.end) in seen[1:]
            return
        here.update(step.after)
    assert run.end == here


ENGINES = {
    "whole": Scope(100_000, small=10**9),
    "cone": Scope(100_000, small=0, engines=()),
    "diagram": Scope(100_000, small=0, near=0),
    "arrays": Scope(100_000, small=0, near=0, engines=("arrays",)),
    "both": Scope(100_000, small=0),
}


def answered(values: dict[str, Any], scope: Scope) -> dict[str, PropertyVerdict]:
    found = proved(blueprint(values), lambda goals: None, scope)
    return {one.name: one for one in found}


@pytest.mark.parametrize("seed", range(share_of(60)))
def test_brute_force_gives_the_same(seed: int) -> None:
    judge(seed, [list(ENGINES)[seed % len(ENGINES)]])


def judge(seed: int, engines: Sequence[str] = tuple(ENGINES)) -> int:
    """Compare the answers of engines about a random blueprint with brute force; return their
    number."""
    chance = Random(seed)
    plain = blueprint_values(seed)
    try:
        start = start_configuration(Hierarchy(blueprint(plain)), {})
    except RunRefused:
        # The verdicts are unknown then.
        values = {"_properties": [{"name": "p", "reachable": "A/0 = 0"}], **plain}
        assert {one.verdict for one in prove(blueprint(values)).verdicts} <= {"unknown"}
        return 1
    brute = Brute(plain, start)
    properties: list[dict[str, Any]] = []
    wanted: dict[str, tuple[str, int | None]] = {}
    for number in range(12):
        (first, f), (second, g) = (drawn_condition(plain, chance) for _ in range(2))
        within = chance.choice((None, 0, 1, 3))
        kind = ("never", "reachable", "before", "after", "way_back", "way_back")[number % 6]
        name, value = f"p{number}", [first, second]
        said: Any = first if kind in ("never", "reachable") else value
        if kind == "way_back":
            said = {"from": first, "to": second} | ({} if within is None else {"within": within})
        length = asked(brute, kind, f, g, within)
        properties.append({"name": name, kind: said})
        wanted[name] = kind, length
    values = {"_properties": properties, **plain}
    for engine in engines:
        found = answered(values, ENGINES[engine])
        for name, (kind, length) in wanted.items():
            verdict, run = found[name], found[name].counterexample
            counted = verdict.configurations
            assert counted == len(brute.configs) or (counted is None and engine != "whole"), name
            assert verdict.bound is None
            if kind == "never" and run is not None and run.during is not None:
                # A passed configuration comes earlier than any committed one.
                assert length is None or len(run.path) < length
            else:
                assert verdict.verdict == ("holds" if length is None else "fails"), name
                assert (len(run.path) if run else None) == length, name
            if run is not None:
                carried_out(blueprint(values), run)
    return len(wanted) * len(engines)


ONE = {"NUM_FACTS": 1}
BASE: dict[str, Any] = {
    "HEADER": {"INITIAL": "S00", "ACTIVATING": "S11", "NUM_FACTS": 2, "SUB_SBS": {"SUB": 0}},
    "S00": {"rise": "S10"},
    "S10": {"fall": "S00", "end": "S11"},
    "S11": {"back": "S10"},
}
SUB: dict[str, Any] = {
    "HEADER": {"INITIAL": "Sm", "ACTIVATING": "S1", "NUM_FACTS": 1},
    "Sm": {"go": "S0"},
    "S0": {"on": "S1"},
    "S1": {"off": "Sm"},
}


def of(*properties: dict[str, Any], **more: Any) -> dict[str, PropertyVerdict]:
    named = [{"name": f"p{n}", **one} for n, one in enumerate(properties)]
    return verdicts({"_properties": named, "BASE": BASE, "SUB": SUB, **more})


def test_what_a_step_passes_counts_for_never_and_not_for_reachable() -> None:
    # Only the rise of the base may take the sub along: nobody can ask for its operations.
    base = {**BASE, "_operations": {"rise": {"requires": {"BASE/1": "0"}}}}
    passed = "SUB in S0 and BASE in S00"
    found = of({"never": passed}, {"never": "SUB in S0 and BASE in S10"}, BASE=base)
    run = found["p0"].counterexample
    assert run is not None
    # The sub may be asked for S0 by itself, and that is committed, with as many operations.
    assert (run.path, run.during) == ((Address("SUB", "Sm", "go"),), None)
    assert found["p1"].verdict == "holds"


@pytest.mark.parametrize("engine", ENGINES)
def test_a_pending_configuration_is_shown_with_its_edge(engine: str) -> None:
    subs = {
        "INITIAL": "S000",
        "ACTIVATING": "S111",
        "NUM_FACTS": 3,
        "SUB_SBS": {"SUB": 0, "TWO": 1},
    }
    base = {"HEADER": subs, "S000": {"both": "S110"}, "S110": {"end": "S111"}, "S111": {}}
    never = "SUB = 1 and TWO = 0"
    values = {
        "_properties": [{"name": "p", "never": never}, {"name": "q", "reachable": never}],
        "BASE": base,
        "SUB": {"HEADER": ONE, "S0": {"on": "S1"}, "S1": {"off": "S0"}},
        "TWO": {"HEADER": ONE, "S0": {"on2": "S1"}, "S1": {"off2": "S0"}},
    }
    found = answered(values, ENGINES[engine])
    run = found["p"].counterexample
    assert run is not None
    assert run.path == (Address("BASE", "S000", "both"),)
    assert run.during == Address("TWO", "S0", "on2")
    assert run.end == {"BASE": "S000", "SUB": "S1", "TWO": "S0"}
    carried_out(blueprint(values), run)
    assert found["q"].verdict == "fails"


TURN: dict[str, Any] = {
    "BASE": {"HEADER": {"INITIAL": "State10", "ACTIVATING": "State01", "NUM_FACTS": 2,
                        "SUB_SBS": {"A": 0, "B": 1}},
             "State10": {"Turn": "State01"}, "State01": {}},
    "A": {"HEADER": {"INITIAL": "State0", "ACTIVATING": "State1"},
          "State0": {"On": "State1"}, "State1": {"Off": "State0"}},
    "B": {"HEADER": {"INITIAL": "State0", "ACTIVATING": "State1"},
          "_operations": {"Prepare": {"requires": {"A/0": "0"}}},
          "State0": {"Prepare": "Statem"}, "Statem": {"Finish": "State1"}, "State1": {}},
}  # fmt: skip
"""Turn switches A off, which is pending until the end, and then B on: its Prepare commits alone."""


@pytest.mark.parametrize("engine", ENGINES)
def test_a_commit_inside_a_step_stands_beside_pending_states(engine: str) -> None:
    """At each moment a pending SB counts with its pending state alone: A is off when B commits."""
    hazards = [{"name": "A on, B prepared", "facts": {"A/0": "1", "B/0": "m"}},
               {"name": "A off, B not prepared", "facts": {"A/0": "0", "B/0": "0"}}]  # fmt: skip
    found = answered({"_hazards": hazards, **TURN}, ENGINES[engine])
    assert found["A on, B prepared"].verdict == "holds"
    pending = found["A off, B not prepared"]
    assert pending.verdict == "fails"
    assert pending.counterexample is not None
    assert str(pending.counterexample.during) == "B/State0/Prepare"
    assert pending.counterexample.end == {"BASE": "State10", "A": "State0", "B": "State0"}


def test_a_run_meets_the_same_hazards_as_its_proof() -> None:
    """The record still has A on when B commits; the sensors, the guard and the proof have not."""
    hazard = {"name": "A on, B prepared", "facts": {"A/0": "1", "B/0": "m"}}
    done = smsl.run(blueprint({"_hazards": [hazard], **TURN}))
    assert done.reason == "goal_reached"
    assert not [one for one in done.events if one.event == "hazard_met"]
    (first, *_) = [one for one in done.events if isinstance(one, Committed)]
    assert first.configuration == {"B": "Statem"}
    other = {"name": "A off, B not prepared", "facts": {"A/0": "0", "B/0": "0"}}
    assert smsl.run(blueprint({"_hazards": [other], **TURN})).reason == "no_route"


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize(
    ("facts", "goes"),
    [
        ({}, True),
        ({"SUB/0": "1", "TWO/0": "0"}, False),  # on the way of ``both``
        ({"SUB/0": "0", "TWO/0": "1"}, True),  # never: SUB rises first
        ({"BASE/2": "1"}, False),  # at the end of ``end``
        ({"BASE/1": "1", "BASE/2": "0"}, False),  # at the end of ``both``
        ({"BASE/2": "0"}, False),  # at the start, and everywhere before ``end``
    ],
)
def test_routes_go_around_hazards_on_the_way(
    engine: str, facts: dict[str, str], goes: bool
) -> None:
    header = {"INITIAL": "S000", "ACTIVATING": "S111", "NUM_FACTS": 3}
    header |= {"SUB_SBS": {"SUB": 0, "TWO": 1}}
    values = {
        "_hazards": [{"name": "h", "facts": facts}] if facts else [],
        "_properties": [
            {"name": "after", "after": ["BASE in S000", "SUB = 1 and TWO = 0"]},
            {"name": "back", "way_back": {"from": "BASE in S000", "to": "BASE in S111"}},
        ],
        "BASE": {"HEADER": header, "S000": {"both": "S110"}, "S110": {"end": "S111"}, "S111": {}},
        "SUB": {"HEADER": ONE, "S0": {"on": "S1"}, "S1": {"off": "S0"}},
        "TWO": {"HEADER": ONE, "S0": {"on2": "S1"}, "S1": {"off2": "S0"}},
    }
    found = answered(values, ENGINES[engine])
    # A way to the goal that leaves out what must come fails; where there is none, it holds.
    assert found["after"].verdict == ("fails" if goes else "holds")
    assert found["back"].verdict == ("holds" if goes else "fails")
    run = found["after"].counterexample
    if run is not None:
        assert [str(one) for one in run.path] == ["BASE/S000/both", "BASE/S110/end"]
    if engine == "diagram":
        assert found["after"].engine == found["back"].engine == "diagram"


@pytest.mark.parametrize("engine", ENGINES)
def test_what_came_after_may_be_owed_again(engine: str) -> None:
    table = {f"S{n}": {"go": f"S{n + 1}"} for n in range(3)} | {"S3": {}}
    values = {
        "_properties": [
            {"name": "again", "after": ["A in S0 or A in S2", "A in S1"]},
            {"name": "once", "after": ["A in S0", "A in S1"]},
        ],
        "A": {"HEADER": ONE, "_operations": {"go": {"requires": {"B/0": "1"}}}, **table},
        "B": {"HEADER": ONE, "S0": {"on": "S1"}, "S1": {}},
    }
    found = answered(values, ENGINES[engine])
    assert found["once"].verdict == "holds"
    if engine == "diagram":
        assert found["again"].engine == "diagram"
    run = found["again"].counterexample
    assert run is not None
    assert [str(one) for one in run.path] == ["B/S0/on", "A/S0/go", "A/S1/go", "A/S2/go"]


def test_routes_go_around_hazards_and_proofs_of_hazards_do_not() -> None:
    flat = {
        "HEADER": {"INITIAL": "S00", "ACTIVATING": "S11", "NUM_FACTS": 2},
        "S00": {"a": "S01", "b": "S10"}, "S01": {"c": "S11"}, "S10": {"d": "S11"}, "S11": {},
    }  # fmt: skip
    after = {"name": "p", "after": ["A/0 = 0 and A/1 = 0", "A in S10"]}
    assert verdicts({"_properties": [after], "A": flat})["p"].verdict == "fails"
    hazards = [{"name": "h", "facts": {"A/0": "0", "A/1": "1"}}]
    found = verdicts({"_properties": [after], "_hazards": hazards, "A": flat})
    assert (found["h"].verdict, found["p"].verdict) == ("fails", "holds")
    assert (found["h"].configurations, found["p"].configurations) == (4, 3)


def test_routes_answer_cost_and_at_most() -> None:
    found = of(
        {"cost": {"goal": "BASE/S11", "limit": 3}},
        {"cost": {"goal": "BASE/S11", "limit": 2}},
        {"at_most": {"operation": "SUB/o?", "times": 1}},
        {"at_most": {"operation": "*", "times": 3}},
        {"cost": {"goal": "SUB/S1", "limit": 9}},
    )
    assert [found[f"p{n}"].verdict for n in range(5)] == [
        "holds", "fails", "holds", "fails", "holds",
    ]  # fmt: skip
    run = found["p1"].counterexample
    assert run is not None
    assert run.path == (Address("BASE", "S00", "rise"), Address("BASE", "S10", "end"))
    assert run.end == {"BASE": "S11", "SUB": "S1"}


def test_the_cheapest_route_goes_around_hazards() -> None:
    edges = {"S00": {"a": "S01", "b": "S10"}, "S01": {"c": "S11"}, "S10": {"d": "S11"}, "S11": {}}
    head = {"ACTIVATING": "S11", "NUM_FACTS": 2}
    flat = {"HEADER": head, "_operations": {"d": {"cost": 4}}, **edges}
    asked: list[Any] = [
        {"name": "cost", "cost": {"goal": "A/S11", "limit": 2}},
        {"name": "few", "at_most": {"operation": "d", "times": 0}},
    ]
    kept = verdicts({"_properties": asked, "A": flat})
    assert [kept[one].verdict for one in ("cost", "few")] == ["holds", "holds"]
    hazards = [{"name": "h", "facts": {"A/0": "0", "A/1": "1"}}]
    found = verdicts({"_properties": asked, "_hazards": hazards, "A": flat})
    for name in ("cost", "few"):
        assert (found[name].verdict, found[name].bound) == ("fails", None)
        run = found[name].counterexample
        assert run is not None
        assert run.path == (Address("A", "S00", "b"), Address("A", "S10", "d"))
    hazards.append({"name": "both", "facts": {"A/0": "1", "A/1": "0"}})
    found = verdicts({"_properties": asked, "_hazards": hazards, "A": flat})
    run = found["cost"].counterexample
    assert (found["cost"].verdict, run and run.path) == ("fails", ())


def test_the_bound_is_told_and_never_hides_a_failure() -> None:
    line = {f"S{n:02}": {"on": f"S{n + 1:02}"} for n in range(40)} | {"S40": {}}
    properties = [
        {"name": "near", "never": "A in S03"},
        {"name": "far", "never": "A in S30"},
        {"name": "reach", "reachable": "A in S30"},
        {"name": "back", "way_back": {"from": "A in S02", "to": "A in S30"}},
    ]
    found = verdicts({"_properties": properties, "A": line}, limit=10)
    assert [found[name].verdict for name in ("near", "far", "reach", "back")] == [
        "fails", "unknown", "unknown", "unknown",
    ]  # fmt: skip
    assert {one.bound for one in found.values()} == {"10 configurations"}
    assert {one.configurations for one in found.values()} == {10}


def test_what_cannot_be_read_is_unknown() -> None:
    found = of({"never": "BASE/7 = 0"}, {"never": "BASE/0 ="}, {"reachable": "SUB = 1"})
    assert [found[f"p{n}"].verdict for n in range(3)] == ["unknown", "unknown", "holds"]
