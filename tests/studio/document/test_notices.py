"""Side effects of an edit are told in one line."""

from __future__ import annotations

import json
from pathlib import Path

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.blueprint.writing import new_blueprint
from smsl_studio.smsl.files import read_document
from smsl_studio.smsl.json_form import parse_json
from smsl_studio.studio.document.notices import (
    StepNotice,
    goal_kept,
    goal_moved,
    step_notice,
    values_given,
)

HANOI = Path(__file__).parents[3] / "samples" / "hanoi.json"


def test_a_new_state_that_takes_over_as_activating_is_told() -> None:
    before = read_blueprint(read_document(HANOI))
    after = editing.add_state(before, "SB1", "State_xyz")
    assert goal_moved(before, after) == (
        "State_xyz is listed last, so it is the activating state of SB1 now. "
        "Set Activating in the branch header to keep State_ccc."
    )
    assert goal_moved(after, before) == ""


def test_where_the_header_names_the_activating_state_there_is_nothing_to_tell() -> None:
    plain = read_blueprint(read_document(HANOI))
    before = editing.set_header(plain, "SB1", "ACTIVATING", "State_ccc")
    assert goal_moved(before, editing.add_state(before, "SB1", "State_xyz")) == ""


def test_while_a_branch_is_being_drawn_the_last_state_is_what_people_expect() -> None:
    blueprint = editing.add_branch(new_blueprint(), "SB1")
    for name in ("State_00", "State_10", "State_11"):
        after = editing.add_state(blueprint, "SB1", name)
        assert goal_moved(blueprint, after) == ""
        blueprint = after


def test_another_file_is_no_edit_of_this_one() -> None:
    hanoi = read_document(HANOI)
    before = read_blueprint(hanoi)
    longer = editing.add_state(before, "SB1", "State_xyz").document.text
    other = read_blueprint(parse_json(longer, "other.json"))
    assert goal_moved(before, other) == ""


def test_that_activating_was_written_to_keep_it_is_told() -> None:
    before = read_blueprint(read_document(HANOI))
    after = editing.keep_activating(before, editing.add_state(before, "SB1", "State_xyz"), ["SB1"])
    assert after["SB1"].activating == "State_ccc"
    assert goal_moved(before, after) == ""
    assert goal_kept(before, after) == (
        "State_ccc stays the activating state of SB1, and ACTIVATING says so now: "
        "State_xyz is listed behind it."
    )
    assert goal_kept(after, before) == ""
    by_hand = editing.set_header(before, "SB1", "ACTIVATING", "State_ccc")
    assert goal_kept(before, by_hand) == ""


def test_only_a_goal_that_moved_is_a_warning() -> None:
    before = read_blueprint(read_document(HANOI))
    moved = editing.add_state(before, "SB1", "State_xyz")
    kept = editing.keep_activating(before, moved, ["SB1"])
    assert step_notice(before, moved) == StepNotice(goal_moved(before, moved), "W", once=True)
    assert step_notice(before, kept) == StepNotice(goal_kept(before, kept))
    assert step_notice(before, before) == StepNotice("", "W", once=True)


def test_fact_values_that_another_state_has_are_not_called_free() -> None:
    given = {"Off": {"facts": ["0"]}, "On": {"facts": ["1"]}}
    before = read_blueprint(
        parse_json(json.dumps({"A": {"Off": {}, "On": {}, "_states": given}}, indent=1), "a.json")
    )
    after = editing.give_facts(before, editing.add_state(before, "A", "Third"))
    assert values_given(before, after) == (
        "Third has the fact values of Off (0), because no other ones are free. "
        "Properties changes them."
    )
    two = editing.delete(before, [Address("A", "On")])
    third = editing.give_facts(two, editing.add_state(two, "A", "Third"))
    assert values_given(two, third) == (
        "Third got the free fact values 1. Properties changes them."
    )


def test_where_no_state_is_left_nobody_asks_for_its_facts() -> None:
    before = read_blueprint(read_document(HANOI))
    states = [Address("SB1", name) for name in before["SB1"].table]
    assert step_notice(before, editing.delete(before, states)).sentence == ""


def test_facts_that_another_state_has_are_a_warning() -> None:
    facts = {"Idle": ["0"], "Ready": ["1"]}
    notes = {name: {"facts": values} for name, values in facts.items()}
    text = json.dumps({"SB1": {**{name: {} for name in facts}, "_states": notes}})
    before = read_blueprint(parse_json(text, "two.json"))
    after = editing.give_facts(before, editing.add_state(before, "SB1", "Third"))
    assert "Third has the fact values of Idle" in step_notice(before, after).sentence
    assert step_notice(before, after).severity == "W"
