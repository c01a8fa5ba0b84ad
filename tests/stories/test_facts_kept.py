"""One edit of one state does not change the facts of all in silence."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from PySide6.QtCore import QPoint, Qt

from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person, sample

Key = Qt.Key
HANOI = SAMPLES / "hanoi-corrected.json"
SUB = {"HEADER": {}, "State0": {"go": "State1"}, "State1": {}}


def _with_sub(folder: Path) -> Path:
    """Hanoi whose fourth fact is 0 in all states and belongs to a sub-SB."""
    text = HANOI.read_text()
    for state in sample("hanoi-corrected.json")["SB1"].table:
        text = text.replace(f'"{state}"', f'"{state}0"')
    values = json.loads(text)
    values["SB1"]["HEADER"] = {"SUB_SBS": {"SB2": 3}}
    made = folder / "sub.json"
    made.write_text(json.dumps({**values, "SB2": SUB}))
    return made


def _add(person: Person, name: str) -> None:
    view = person.window.canvas.viewport()
    person.double_click_canvas(QPoint(view.width() // 2, view.height() - 90))
    person.type(name)
    person.press(Key.Key_Return)
    assert name in person.blueprint["SB1"].table


def test_a_new_state_turns_no_fact_of_a_sub_sb_over(sit: Sit, tmp_path: Path) -> None:
    person = sit(_with_sub(tmp_path))
    assert person.blueprint["SB1"].on_value(3) == "1"
    _add(person, "zzz9")
    branch = person.blueprint["SB1"]
    assert branch.on_value(3) == "1"
    assert not branch.is_on("State_aaa0", 3)
    assert "1 stays the value with which Fact 4 of SB1 is on" in person.window.toast.words
    person.ctrl(Key.Key_Z)
    assert person.blueprint["SB1"].fact_note(3) is None


def test_a_typed_text_that_turns_a_fact_over_is_told(sit: Sit, tmp_path: Path) -> None:
    person = sit(_with_sub(tmp_path))
    session = person.window.session
    typed = session.blueprint.document.text.replace('"State_ccc0"', '"State_ccc9"')
    session.write("Type", typed)
    assert session.blueprint["SB1"].on_value(3) == "9"
    assert not person.window.toast.words, "no state that was off is on now"
    session.write("Type", typed.replace('"State_ccc9"', '"State_ccc0"').replace("bcc0", "bcc9"))
    assert session.blueprint["SB1"].on_value(3) == "0"
    assert "Fact 4 of SB1 is on where it is 0 now" in person.window.toast.words


@pytest.mark.parametrize("name", ["State_start", "State_ab", "aaa!"])
def test_a_renamed_state_leaves_all_facts_as_they_were(sit: Sit, name: str) -> None:
    person = sit(HANOI)
    text, toast, before = person.blueprint.document.text, person.window.toast, person.blueprint
    person.click_canvas(person.place("SB1/State_aaa"))
    person.press(Key.Key_F2)
    person.type(name)
    person.press(Key.Key_Return)
    branch, former = person.blueprint["SB1"], before["SB1"]
    assert branch.facts(name) == ("a", "a", "a")
    assert [branch.facts(one) for one in branch.table] == [
        former.facts(one) for one in former.table
    ]
    assert toast.words == (
        f"{name} does not carry facts in its name. All states of SB1 keep theirs: they stand in "
        "_states now."
    )
    person.ctrl(Key.Key_Z)
    assert person.blueprint.document.text == text


def test_a_plain_word_takes_the_facts_of_all_and_that_is_told_with_undo(sit: Sit) -> None:
    person = sit(HANOI)
    text, toast = person.blueprint.document.text, person.window.toast
    person.click_canvas(person.place("SB1/State_aaa"))
    person.press(Key.Key_F2)
    person.type("start")
    person.press(Key.Key_Return)
    assert toast.words == (
        "start does not carry 3 facts like the other states, so no state of SB1 has them "
        "now: each has one fact, its own name. Rules about facts find nothing."
    )
    person.click(toast.button)
    assert person.blueprint.document.text == text


def test_a_new_state_that_takes_the_facts_of_all_is_told_too(sit: Sit) -> None:
    person = sit(HANOI)
    _add(person, "State_start")
    assert "State_start does not carry 3 facts" in person.window.toast.words
    assert person.blueprint["SB1"].shape.opaque


def test_a_renamed_state_with_facts_says_nothing(sit: Sit) -> None:
    person = sit(HANOI)
    person.click_canvas(person.place("SB1/State_aaa"))
    person.press(Key.Key_F2)
    person.type("State_aad")
    person.press(Key.Key_Return)
    assert not person.window.toast.isVisible()
