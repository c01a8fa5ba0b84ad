"""What a world lacks for a blueprint (R24 to R26), with bindings that are written by hand."""

from __future__ import annotations

import json
from typing import Any

import pytest

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import Place
from smsl_studio.inspection.in_world import inspect_in_world
from smsl_studio.inspection.rules.finding import Finding
from smsl_studio.library.bound import BindingFault, Bindings, BoundOperation, BoundSensor
from smsl_studio.library.table import table_bindings
from smsl_studio.shipped import samples_dir
from tests.inspection.intact import intact_files, read

WORLD = "room"


def blueprint(**fields: Any) -> Blueprint:
    """A base with a sub-SB on digit 0, and a digit 1 of its own."""
    file_fields = {key: fields.pop(key) for key in list(fields) if key in ("_levels",)}
    base = {
        "HEADER": {"SUB_SBS": {"SUB": 0}, "INITIAL": "State_00", "ACTIVATING": "State_11"},
        **fields,
        "State_00": {"rise": "State_10"},
        "State_10": {"work": "State_11", "fall": "State_00"},
        "State_11": {"undo": "State_10"},
    }
    sub = {"State_0": {"up": "State_1"}, "State_1": {"down": "State_0"}}
    return read({**file_fields, "BASE": base, "SUB": sub})


EDGES = ("BASE/State_10/work", "BASE/State_11/undo", "SUB/State_0/up", "SUB/State_1/down")
"""The edges that need a function: a rise and a fall need none."""
FACTS = (("BASE", 1), ("SUB", 0))


def equipped(
    edges: tuple[str, ...] = EDGES,
    facts: tuple[tuple[str, int], ...] = FACTS,
    faults: tuple[BindingFault, ...] = (),
) -> Bindings:
    operation = BoundOperation("f", print, {}, False, "hold", 1.0)
    bound = {Address(*Address.split(edge)): operation for edge in edges}
    sensors = [BoundSensor("s", *fact, 0.1, 0.3, "single", print, {}) for fact in facts]
    return Bindings(bound, tuple(sensors), faults)


def told(found: tuple[Finding, ...]) -> list[tuple[str, str, str]]:
    return [(one.rule, one.severity.value, str(one.address)) for one in found]


def test_a_world_with_everything_has_no_finding() -> None:
    assert inspect_in_world(blueprint(), WORLD, equipped()) == ()


def test_an_operation_without_a_function_is_an_error_and_a_persons_needs_none() -> None:
    found = inspect_in_world(blueprint(), WORLD, equipped(EDGES[1:]))
    assert told(found) == [("R24", "E", "BASE/State_10/work")]
    person = blueprint(_operations={"work": {"actor": "human"}})
    assert inspect_in_world(person, WORLD, equipped(EDGES[1:])) == ()


def test_a_binding_that_does_not_fit_is_one_error_for_all_its_edges() -> None:
    place = Place("room.toml", 3, 1)
    faults = tuple(BindingFault(edge, "f: disk is no number", place) for edge in EDGES[:2])
    (found,) = inspect_in_world(blueprint(), WORLD, equipped(EDGES[2:], faults=faults))
    assert (found.rule, found.severity.value, found.place) == ("R24", "E", place)
    assert [str(one) for one in found.addresses] == list(EDGES[:2])
    assert "disk is no number" in found.message


def test_a_sensor_at_a_sub_digit_is_an_error_and_its_fix_takes_it_away() -> None:
    before = blueprint(_facts={"0": {"name": "Clamp", "sensors": ["eye"]}})
    (found,) = inspect_in_world(before, WORLD, equipped())
    assert told((found,)) == [("R24", "E", "BASE")]
    assert '"0"' in before.document.text.splitlines()[found.place.line - 1]
    assert found.fix is not None
    after = found.fix.apply(before)
    note = after["BASE"].fact_note(0)
    assert note is not None
    assert (note.name, note.sensors) == ("Clamp", ())
    assert inspect_in_world(after, WORLD, equipped()) == ()


def test_a_fact_that_is_changed_and_not_sensed_is_a_warning_and_its_fix_asks_a_person() -> None:
    before = blueprint()
    (found,) = inspect_in_world(before, WORLD, equipped(facts=FACTS[1:]))
    assert told((found,)) == [("R25", "W", "BASE")]
    assert "fact 2" in found.message
    assert found.fix is not None
    after = found.fix.apply(before)
    assert after.levels == {"BASE/1": "shared"}
    assert inspect_in_world(after, WORLD, equipped(facts=FACTS[1:])) == ()


@pytest.mark.parametrize(
    ("facts", "note", "alone"),
    [
        (FACTS, {"critical": True}, True),
        ((*FACTS, ("BASE", 1)), {"critical": True}, False),
        (FACTS, {"critical": False}, False),
        (FACTS, {"critical": True, "aggregation": "human", "roles": ["nurse"]}, True),
        (FACTS, {"critical": True, "aggregation": "human", "roles": ["nurse", "nurse"]}, False),
    ],
)
def test_a_critical_fact_needs_two_sources(
    facts: tuple[tuple[str, int], ...], note: dict[str, Any], alone: bool
) -> None:
    found = inspect_in_world(blueprint(_facts={"1": note}), WORLD, equipped(facts=facts))
    assert told(found) == [("R25", "W", "BASE")] * alone


@pytest.mark.parametrize(
    ("operations", "facts", "level", "wrong"),
    [
        ({"work": {"risk": "high"}}, {}, "shared", True),
        ({"work": {"risk": "high", "confirm": ["surgeon"]}}, {}, "shared", False),
        ({"work": {"risk": "high"}}, {}, "automatic", False),
        ({"work": {"risk": "high"}}, {}, "human", False),
        ({"work": {"risk": "low"}}, {}, "shared", False),
        ({}, {"1": {"critical": True}}, "shared", True),
    ],
)
def test_a_shared_grave_operation_needs_roles_that_confirm_it(
    operations: dict[str, Any], facts: dict[str, Any], level: str, wrong: bool
) -> None:
    levels = {"BASE/work": level}
    before = blueprint(_levels=levels, _operations=operations, _facts=facts)
    found = inspect_in_world(before, WORLD, equipped(), ["R26"])
    assert told(found) == [("R26", "E", "BASE/State_10/work")] * wrong
    for one in found:
        assert one.fix is not None
        assert inspect_in_world(one.fix.apply(before), WORLD, equipped(), ["R26"]) == ()


def test_the_table_world_has_everything_for_every_intact_file() -> None:
    for name, values in intact_files().items():
        whole = read(values)
        found = inspect_in_world(whole, "table", table_bindings(whole))
        people = name == "registration-people"
        assert told(found) == [("R25", "W", "HEAD")] * people, name


def test_a_blueprint_with_a_cycle_or_without_states_is_inspected() -> None:
    cycle: Any = {"A": {"HEADER": {"SUB_SBS": {"A": 0}}, "State_0": {"a": "State_0"}}}
    empty: Any = {"A": {"HEADER": {}}}
    nothing: Any = {}
    for written in (cycle, nothing, empty):
        assert inspect_in_world(read(written), WORLD, equipped((), ())) == ()


def test_the_levels_of_the_sample_with_people_stay() -> None:
    text = (samples_dir() / "registration-people.json").read_text("utf-8")
    whole = read(json.loads(text))
    found = inspect_in_world(whole, "table", table_bindings(whole), ["R26"])
    assert found == ()
