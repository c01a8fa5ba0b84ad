"""Into a sub-SB and back by keys: what is read out, and what is selected on return."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt

from tests.stories.conftest import Heard, Sit
from tests.stories.person import SAMPLES

Key = Qt.Key
HFSM = SAMPLES / "hfsm.json"


@pytest.mark.parametrize("chosen", ["SB1/State110", "SB1/State110/Operation110B"])
def test_enter_and_backspace_say_where_one_is_and_lead_back(
    sit: Sit, heard: Heard, chosen: str
) -> None:
    person = sit(HFSM)
    person.select(chosen)
    heard.clear()
    person.press(Key.Key_Return)
    assert person.window.session.branch == "SB2"
    told = [words for words, _ in heard]
    assert told == ["SB2, 2 states. It expands Fact 2 of SB1."]
    person.press(Key.Key_Backspace)
    assert [words for words, _ in heard][1:] == ["SB1, 4 states."]
    assert person.selected() == [chosen]
    heard.clear()
    person.press(Key.Key_Backspace)
    assert [words for words, _ in heard] == ["SB1 is the top: no fact has it as its sub-SB."]
    assert person.selected() == [chosen]


def test_what_was_let_go_before_is_not_selected_again(sit: Sit) -> None:
    person = sit(HFSM)
    person.select("SB1/State110")
    person.press(Key.Key_Escape)
    person.press(Key.Key_Return)
    assert person.window.session.branch == "SB2"
    person.press(Key.Key_Backspace)
    assert person.window.session.branch == "SB1"
    assert person.selected() == []


def test_the_menu_and_the_tree_say_it_too(sit: Sit, heard: Heard) -> None:
    person = sit(HFSM)
    person.select("SB1/State100")
    heard.clear()
    person.window.canvas.enter_wanted.emit("SB2")
    person.window.actions_table["leave"].trigger()
    assert [words.split(",")[0] for words, _ in heard] == ["SB2", "SB1"]
    assert person.selected() == ["SB1/State100"]
