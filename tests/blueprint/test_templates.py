"""The edits of templates: a recovery, more tries, a sub-SB; and the copy of one state."""

from __future__ import annotations

import json
from typing import Any

import pytest

from smsl_studio.blueprint import editing as edit
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.editing.templates import free_digit
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.names import next_free_facts
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import EditRefused
from smsl_studio.front.routes import plan_route
from smsl_studio.inspection.inspect import inspect
from smsl_studio.smsl.json_form import parse_json

STATES = {
    "State_00": {"Op_Grip": "State_10"},
    "State_10": {"Op_Place": "State_01", "Op_Release": "State_00"},
    "State_01": {},
}


def blueprint(inner: dict[str, Any] | None = None, **fields: Any) -> Blueprint:
    header = {"INITIAL": "State_00", "ACTIVATING": "State_01", "NUM_FACTS": 2}
    whole = {"VIAL": {"HEADER": header, **(inner or STATES), **fields}}
    return read_blueprint(parse_json(json.dumps(whole, indent=4), "vial.json"))


def rules(checked: Blueprint) -> list[str]:
    """The rules that find more than a note, with their severity."""
    found = [f"{one.rule} {one.severity.value}" for one in inspect(checked)]
    return sorted(one for one in found if not one.endswith("I"))


def state(name: str) -> Address:
    return Address("VIAL", name)


# A recovery


def test_a_recovery_is_a_failure_state_and_an_operation_back() -> None:
    after, made = edit.add_recovery(blueprint(), state("State_10"), (8.0, 16.0))
    assert made == (state("State_1x"), Address("VIAL", "State_1x", "Op_Recover"))
    branch = after["VIAL"]
    assert branch.table["State_1x"] == {"Op_Recover": "State_10"}
    assert branch.notes.layout["State_1x"] == (8.0, 16.0)
    note = branch.fact_note(1)
    assert note is not None
    assert (note.failure, note.values, note.on) == (("x",), {"x": "failed"}, "1")
    assert branch.on_value(1) == "1", "what is on stays on"
    # A failure state is entered from outside, and a rule says so.
    assert rules(after) == ["R10 W"]


def test_a_second_recovery_takes_the_declared_value_and_another_name() -> None:
    once, _ = edit.add_recovery(blueprint(), state("State_10"))
    after, made = edit.add_recovery(once, state("State_00"))
    assert made == (state("State_0x"), Address("VIAL", "State_0x", "Op_Recover2"))
    note = after["VIAL"].fact_note(1)
    assert note is not None
    assert note.failure == ("x",)


def test_the_recovery_of_a_state_that_has_one_gets_another_failure() -> None:
    once, _ = edit.add_recovery(blueprint(), state("State_10"))
    after, made = edit.add_recovery(once, state("State_10"))
    assert made[0] == state("State_1f")
    assert after["VIAL"].table["State_1f"] == {"Op_Recover2": "State_10"}


def test_a_declared_failure_value_is_used_before_a_new_one() -> None:
    before = blueprint(_facts={"0": {"name": "Gripped", "failure": ["e"], "on": "1"}})
    after, made = edit.add_recovery(before, state("State_10"))
    assert made[0] == state("State_e0")
    assert after["VIAL"].fields["_facts"] == before["VIAL"].fields["_facts"]


def test_states_whose_names_show_no_facts_can_fail_too() -> None:
    inner = {"Idle": {"Go": "Moving"}, "Moving": {"Stop": "Idle"}}
    opaque = read_blueprint(parse_json(json.dumps({"VIAL": inner}), "f.json"))
    after, made = edit.add_recovery(opaque, state("Idle"))
    assert made == (state("Idle_failed"), Address("VIAL", "Idle_failed", "Recover"))
    note = after["VIAL"].fact_note(0)
    assert note is not None
    assert note.failure == ("Idle_failed",)
    given = {"Idle": {"facts": ["0"]}, "Moving": {"facts": ["1"]}}
    beside = read_blueprint(parse_json(json.dumps({"VIAL": {**inner, "_states": given}}), "f.json"))
    after, made = edit.add_recovery(beside, state("Idle"))
    assert after["VIAL"].facts(made[0].state) == ("x",)


def test_a_recovery_needs_a_state_with_a_fact_of_its_own() -> None:
    sub = {"State0": {"Operation0": "State1"}, "State1": {"Operation1": "State0"}}
    base = {"HEADER": {"SUB_SBS": {"SUB": 0}}, "State_0": {"Go": "State_1"}, "State_1": {}}
    whole = read_blueprint(parse_json(json.dumps({"VIAL": base, "SUB": sub}), "f.json"))
    with pytest.raises(EditRefused, match="no fact of State_0"):
        edit.add_recovery(whole, state("State_0"))
    for odd in (Address("VIAL"), Address("VIAL", "State_00", "Op_Grip")):
        with pytest.raises(EditRefused, match="is no state"):
            edit.add_recovery(blueprint(), odd)
    with pytest.raises(EditRefused, match="no map"):
        edit.add_recovery(blueprint(_facts={"1": 5}), state("State_10"))


# More tries


def test_tries_are_parallel_operations_of_rising_cost_with_the_same_notes() -> None:
    notes = {"Op_Grip": {"title": "Grip", "binding": {"function": "grip"}, "timeout": 5}}
    before = blueprint(_operations=notes)
    after, made = edit.add_tries(before, Address("VIAL", "State_00", "Op_Grip"))
    names = ["Op_Grip_try2", "Op_Grip_try3"]
    assert [address.operation for address in made] == names
    branch = after["VIAL"]
    assert branch.table["State_00"] == dict.fromkeys(["Op_Grip", *names], "State_10")
    assert [branch.cost("State_00", name) for name in ("Op_Grip", *names)] == [1, 2, 3]
    second = branch.operation_note("State_00", "Op_Grip_try2")
    assert second.title == "Grip, try 2"
    assert second.binding is not None
    assert second.binding.function == "grip"
    assert second.timeout == 5
    assert rules(after) == rules(before) == []


def test_the_route_takes_the_first_try_then_the_others() -> None:
    after, made = edit.add_tries(blueprint(), Address("VIAL", "State_00", "Op_Grip"))
    tries = [Address("VIAL", "State_00", "Op_Grip"), *made]
    for failed in range(3):
        route = plan_route(after, state("State_00"), state("State_01"), tries[:failed])
        assert route is not None
        assert route.operations[0] == tries[failed]
    assert plan_route(after, state("State_00"), state("State_01"), tries) is None


def test_a_written_cost_is_kept_and_raised() -> None:
    before = blueprint(_operations={"Op_Grip": {"cost": 2.5}})
    after, _ = edit.add_tries(before, Address("VIAL", "State_00", "Op_Grip"))
    costs = [after["VIAL"].cost("State_00", name) for name in after["VIAL"].table["State_00"]]
    assert costs == [2.5, 3.5, 4.5]
    assert "State_00/Op_Grip" not in after["VIAL"].fields["_operations"]


def test_only_an_operation_to_another_state_gets_tries() -> None:
    with pytest.raises(EditRefused, match="is no operation"):
        edit.add_tries(blueprint(), state("State_00"))
    loop = edit.add_operation(blueprint(), "VIAL", "State_00", "Op_Wait", "State_00")
    with pytest.raises(EditRefused, match="leads back to State_00"):
        edit.add_tries(loop, Address("VIAL", "State_00", "Op_Wait"))
    odd = blueprint(_operations={"State_00/Op_Grip": 5})
    with pytest.raises(EditRefused, match="no map"):
        edit.add_tries(odd, Address("VIAL", "State_00", "Op_Grip"))


# A sub-SB


def test_a_new_sub_sb_of_two_states_expands_the_fact() -> None:
    after, made = edit.expand_fact(blueprint(), "VIAL", 1)
    assert after["VIAL"].subs == {1: "SB1"}
    assert made == (Address("SB1", "State0"), Address("SB1", "State1"))
    sub = after["SB1"]
    assert (sub.initial, sub.activating) == ("State0", "State1")
    assert sub.table == {"State0": {"Operation0": "State1"}, "State1": {"Operation1": "State0"}}
    assert rules(after) == ["R14 W"], "one operation of the sample moves both facts"


def test_a_sub_sb_is_refused_where_attaching_is() -> None:
    once, _ = edit.expand_fact(blueprint(), "VIAL", 0)
    for digit, words in ((0, "already expanded"), (2, "no digit 2")):
        with pytest.raises(EditRefused, match=words):
            edit.expand_fact(once, "VIAL", digit)


def test_the_first_fact_without_a_sub_sb_and_a_sensor_is_free() -> None:
    assert free_digit(blueprint()["VIAL"]) == 0
    assert free_digit(blueprint(_facts={"0": {"sensors": ["camera"]}})["VIAL"]) == 1
    assert free_digit(edit.expand_fact(blueprint(), "VIAL", 0)[0]["VIAL"]) == 1


# A copy


def test_the_next_free_facts_count_up_from_those_of_the_state() -> None:
    branch = blueprint()["VIAL"]
    assert {name: next_free_facts(branch, name) for name in branch.table} == {
        "State_00": ("1", "1"), "State_10": ("1", "1"), "State_01": ("1", "1"),
    }  # fmt: skip
    one = blueprint({"State_00": {}, "State_11": {}})["VIAL"]
    assert next_free_facts(one, "State_00") == ("0", "1")
    assert next_free_facts(one, "State_11") == ("1", "0")


def test_failure_values_are_proposed_only_beside_other_facts() -> None:
    facts = {"1": {"failure": ["x"], "on": "1"}}
    branch = blueprint({"State_00": {}, "State_0x": {}}, _facts=facts)["VIAL"]
    assert next_free_facts(branch, "State_00") == ("0", "1")
    assert next_free_facts(branch, "State_0x") == ("0", "1")


def test_if_all_facts_are_taken_a_new_value_is_proposed() -> None:
    inner: dict[str, Any] = {f"State_{a}{b}": {} for a in "01" for b in "01"}
    branch = blueprint(inner)["VIAL"]
    values = next_free_facts(branch, "State_11")
    assert len(values) == 2
    assert "State_" + "".join(values) not in branch.table


def test_names_without_facts_have_no_next_ones() -> None:
    opaque = read_blueprint(parse_json('{"SB": {"Idle": {}, "Moving": {}}}', "f.json"))["SB"]
    assert next_free_facts(opaque, "Idle") == ()


def test_a_state_is_copied_under_a_name_with_its_loops_notes_and_a_place() -> None:
    before = edit.add_operation(blueprint(), "VIAL", "State_10", "Op_Wait", "State_10")
    before = edit.set_note(before, "VIAL", "_states", "State_10", {"title": "Held", "safe": True})
    after = edit.duplicate_state(before, state("State_10"), "State_11", (40.0, 48.0))
    branch = after["VIAL"]
    assert branch.table["State_11"] == {"Op_Wait": "State_11"}
    note = branch.state_note("State_11")
    assert note is not None
    assert (note.title, note.safe) == ("Held", True)
    assert branch.notes.layout["State_11"] == (40.0, 48.0)
    for odd, name in ((state("State_10"), "State_01"), (state("State_10"), ""),
                      (Address("VIAL"), "State_11")):  # fmt: skip
        with pytest.raises(EditRefused):
            edit.duplicate_state(before, odd, name)
