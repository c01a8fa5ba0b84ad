"""A text of rules while somebody writes it, and its differences to a drawing."""

from __future__ import annotations

import pytest

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.rule_differences import rule_comparison, taken
from smsl_studio.front.rule_draft import MOST_SHOWN, RuleDraft, rule_draft
from smsl_studio.shipped import samples_dir

RIVER = (samples_dir() / "rules" / "river.toml").read_text("utf-8")


def river(text: str = RIVER) -> RuleDraft:
    return rule_draft(text, "river.rules.toml")


def drawing() -> Blueprint:
    made = river().blueprint
    assert made is not None
    return made


def test_a_whole_text_gives_its_blueprint() -> None:
    draft = river()
    assert (draft.faults, draft.states, draft.operations) == ((), 40, 92)
    assert draft.goal_reached
    assert draft.whole
    assert draft.blueprint is not None
    assert draft.blueprint.file == "river.json"
    assert draft.blueprint.fields["_origin"]["how"] == "rules"
    (branch,) = draft.blueprint
    assert [branch.fact_name(digit) for digit in range(4)] == ["grass", "sheep", "steve", "wolf"]
    assert draft.combinations is not None
    assert draft.rules is not None
    assert len(draft.combinations) == len(draft.rules.never)


def test_a_rule_that_cannot_be_read_is_left_out_and_told_with_its_line() -> None:
    wrong = RIVER + '\n[[rule]]\noperation = "call"\ncases = [{when = "wolf = x", set = {}}]\n'
    draft = river(wrong)
    assert (draft.states, draft.operations) == (40, 92)
    (fault,) = draft.faults
    assert fault.place is not None
    assert fault.place.line == wrong.count("\n")
    assert "wolf" in fault.sentence


def test_a_condition_of_never_that_cannot_be_read_is_left_out() -> None:
    draft = river(RIVER.replace("never = [", 'never = ["boat = 7",', 1))
    assert len(draft.faults) == 1
    assert draft.states == 40


@pytest.mark.parametrize(
    ("text", "words"),
    [("facts = [", "TOML"), ("", "facts"), (RIVER.replace('start = ["0"', 'start = ["9"'), "9")],
)
def test_a_text_that_gives_nothing_says_why(text: str, words: str) -> None:
    draft = river(text)
    assert draft.blueprint is None
    assert draft.branch is None
    assert words in draft.faults[-1].sentence + draft.faults[-1].advice


def test_too_many_states_are_shown_in_part_and_never_as_the_whole() -> None:
    digits = ", ".join(f'{{name = "n{at}", values = ["0", "1"]}}' for at in range(20))
    text = f"""facts = [{digits}]
start = [{", ".join('"0"' for _ in range(20))}]
[[rule]]
operation = "set_{{x}}"
for = {{x = [{", ".join(f'"n{at}"' for at in range(20))}]}}
cases = [{{when = "{{x}} = 0", set = {{"{{x}}" = "1"}}}}]
"""
    draft = river(text)
    assert draft.faults == ()
    assert (draft.states, draft.whole, draft.combinations) == (MOST_SHOWN, False, None)
    assert draft.branch is not None
    assert {t for ops in draft.branch.table.values() for t in ops.values()} <= set(
        draft.branch.table
    )


def test_the_differences_to_a_drawing_are_taken_one_by_one() -> None:
    ruled = river().branch
    assert ruled is not None
    drawn = drawing()
    name = next(iter(drawn)).name
    states = list(drawn[name].table)
    first = next(state for state in states if drawn[name].table[state])
    operation, target = next(iter(drawn[name].table[first].items()))
    other = next(state for state in states if state not in (first, target))
    second = next(state for state in states[5:] if drawn[name].table[state] and state != first)
    gone = next(iter(drawn[name].table[second]))
    drawn = editing.retarget(drawn, Address(name, first, operation), other)
    drawn = editing.delete(drawn, [Address(name, second, gone)])
    drawn = editing.add_operation(drawn, name, states[3], "jump", states[0])
    found = rule_comparison(ruled, drawn[name])
    assert found.same == 90
    assert {(one.kind, one.state, one.operation) for one in found.differences} == {
        ("target", first, operation), ("missing", second, gone), ("odd", states[3], "jump"),
    }  # fmt: skip
    for number in range(len(found.differences), 0, -1):
        left = rule_comparison(ruled, drawn[name]).differences
        assert len(left) == number
        drawn = taken(drawn, name, left[:1])
    assert drawn[name].table == ruled.table


def test_states_that_the_drawing_lacks_are_added_and_other_names_are_kept() -> None:
    ruled = river().branch
    assert ruled is not None
    drawn = drawing()
    name = next(iter(drawn)).name
    drawn = editing.delete(drawn, [Address(name, list(drawn[name].table)[7])])
    found = rule_comparison(ruled, drawn[name])
    again = taken(drawn, name, found.differences)[name]
    assert rule_comparison(ruled, again).differences == ()
    assert again.table.keys() == ruled.table.keys()


def test_without_a_rule_there_is_the_start_alone() -> None:
    draft = river(RIVER[: RIVER.index("[[rule]]")])
    assert (draft.states, draft.operations, draft.goal_reached) == (1, 0, False)
    assert [fault.sentence for fault in draft.faults] == ["there is no [[rule]]"]
