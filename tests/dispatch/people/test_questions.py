"""Questions to people use the words of the blueprint, and can always be answered with no."""

from __future__ import annotations

import json
from typing import Any

import pytest

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.dispatch.people import questions as ask
from smsl_studio.dispatch.people.board import Question
from smsl_studio.smsl.json_form import parse_json

FILE: dict[str, Any] = {
    "A": {
        "_facts": {
            "0": {
                "name": "Tracker seen",
                "values": {"0": "hidden", "1": "seen", "x": "broken off"},
                "failure": ["x"],
                "question": "Does the camera see the tracker?",
                "roles": ["surgeon", "nurse"],
                "answer_within": 30,
                "escalates_to": "head",
            }
        },
        "_states": {"State_00": {"title": "Prepared"}},
        "_operations": {
            "go": {
                "title": "Clamp the head",
                "question": "Close the clamp and pull once.",
                "roles": ["nurse"],
                "confirm": ["surgeon", "anaesthetist"],
                "risk": "high",
                "answer_within": 45,
                "escalates_to": "head",
            }
        },
        "State_00": {"go": "State_10", "wait": "State_00"},
        "State_10": {"back": "State_00"},
    }
}
GO, BACK = Address("A", "State_00", "go"), Address("A", "State_10", "back")


def made(file: dict[str, Any] = FILE) -> Blueprint:
    return read_blueprint(parse_json(json.dumps(file), "x.json"))


def test_a_human_operation_is_a_task_of_its_role() -> None:
    task = ask.operation_task(made(), GO)
    assert (task.kind, task.address, task.roles) == ("operation", "A/State_00/go", ("nurse",))
    assert task.question == "Close the clamp and pull once."
    assert task.detail == "A: State_00 (Prepared) to State_10. Risk: high."
    assert (task.within, task.escalation) == (45, "head")
    plain = ask.operation_task(made(), BACK)
    assert (plain.question, plain.roles) == ("back: please carry it out", ("",))


def test_a_confirmation_takes_one_person_of_each_role() -> None:
    task = ask.confirm_task(made(), GO)
    assert task.question == "Clamp the head: may it begin?"
    assert task.roles == ("surgeon", "anaesthetist")
    assert ask.confirm_task(made(), BACK).roles == ("",)


def test_a_fact_may_be_any_of_its_values_or_not_be_known() -> None:
    task = ask.fact_task(made(), ("A", 0), "nobody has answered yet")
    assert task.question == "Does the camera see the tracker?"
    assert task.detail == "Tracker seen of A is unknown: nobody has answered yet."
    assert [(one.value, one.words, one.yes) for one in task.options] == [
        ("0", "hidden", True),
        ("1", "seen", True),
        ("x", "broken off", True),
        ("cannot say", "I cannot say", False),
    ]
    assert (task.roles, task.within, task.escalation) == (("surgeon", "nurse"), 30, "head")
    plain = ask.fact_task(made(), ("A", 1))
    assert plain.question == "What is Fact 2 of A?"
    assert plain.roles == ("",)


def test_no_value_passes_for_not_knowing() -> None:
    states = {"State_a": {"go": "State_b"}, "State_b": {}}
    file = {"A": {**states, "_facts": {"0": {"values": {"cannot say": "mute"}}}}}
    options = ask.fact_task(made(file), ("A", 0)).options
    assert [one.value for one in options] == ["a", "b", "cannot say", "cannot say?"]
    assert [one.yes for one in options] == [True, True, True, False]


@pytest.mark.parametrize(
    "task",
    [
        ask.operation_task(made(), GO),
        ask.confirm_task(made(), GO),
        ask.fact_task(made(), ("A", 1)),
        ask.supervise_task(made(), GO, "No risk is declared."),
        ask.start_task("2 errors, 1 warning."),
    ],
)
def test_every_task_can_be_answered_with_a_no(task: Question) -> None:
    assert any(option.yes for option in task.options)
    assert not all(option.yes for option in task.options)
    assert len({option.value for option in task.options}) == len(task.options)
