"""Copy, cut, paste and duplicate: in one window, into another one, and from any text."""

from __future__ import annotations

import json
from collections.abc import Iterator

import pytest
from PySide6.QtCore import QMimeData, QPoint, Qt
from PySide6.QtGui import QGuiApplication

from smsl_studio.picture.levels import Floats
from smsl_studio.smsl.forms import form_named
from smsl_studio.studio.base.canvas.sheet import Sheet
from smsl_studio.studio.features.draw.canvas.clipboard import KIND
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key = Qt.Key
HANOI, HFSM = SAMPLES / "hanoi.json", SAMPLES / "hfsm.json"


@pytest.fixture(autouse=True)
def empty_clipboard(qapp: QGuiApplication) -> Iterator[None]:
    """What one story leaves on the clipboard is not there in the next."""
    yield
    QGuiApplication.clipboard().clear()


def put(text: str) -> None:
    """Text from another program."""
    data = QMimeData()
    data.setText(text)
    QGuiApplication.clipboard().setMimeData(data)


def come(person: Person) -> None:
    """Turn to this window."""
    person.come_back()
    person.window.canvas.setFocus()


def test_states_are_pasted_from_another_window(sit: Sit) -> None:
    here = sit(HFSM)
    here.select("SB1/State100", "SB1/State110")
    here.ctrl(Key.Key_C)
    assert here.window.toast.words == "Copied 2 states."
    text = QGuiApplication.clipboard().text()
    assert "State100" in text
    assert "Operation100A -> State110" in text
    assert bytes(QGuiApplication.clipboard().mimeData().data(KIND).data()).decode() == text
    other = sit()
    come(other)
    other.ctrl(Key.Key_V)
    shown = other.blueprint[other.window.session.branch]
    assert list(shown.table) == ["State100", "State110"]
    assert shown.table["State100"] == {"Operation100A": "State110"}
    assert other.selected() == ["SB1/State100", "SB1/State110"]
    assert other.steps() == ["Paste 2 states"]
    other.ctrl(Key.Key_Z)
    assert not other.blueprint["SB1"].table
    assert here.blueprint.document.text == HFSM.read_text()


def test_what_is_cut_goes_as_one_step_and_comes_back_where_it_is_pasted(sit: Sit) -> None:
    person = sit(HFSM)
    person.select("SB1/State110")
    person.ctrl(Key.Key_X)
    assert "State110" not in person.blueprint["SB1"].table
    assert person.steps() == ["Cut State110"]
    at = QPoint(420, 330)
    person.move_to(at)
    menu_place = person.window.canvas.mapToScene(at)
    person.window.clipping.paste(menu_place)
    assert person.selected() == ["SB1/State110"]
    x, y = person.blueprint["SB1"].notes.layout["State110"]
    assert abs(x - menu_place.x()) <= 16
    assert abs(y - menu_place.y()) <= 16
    person.ctrl(Key.Key_Z)
    person.ctrl(Key.Key_Z)
    assert person.blueprint.document.text == HFSM.read_text()


def test_a_duplicate_lies_beside_and_is_selected(sit: Sit) -> None:
    person = sit(HANOI)
    person.select("SB1/State_aaa", "SB1/State_baa")
    person.ctrl(Key.Key_D)
    assert len(person.blueprint["SB1"].table) == 29
    assert len(person.selected()) == 2
    assert person.steps() == ["Duplicate 2 states"]


def test_keys_in_a_text_field_mean_its_own_text(sit: Sit) -> None:
    person = sit(HFSM)
    person.select("SB1/State110")
    title = person.window.properties.state.title
    person.write(title, "Half way")
    person.click(title)
    title.selectAll()
    person.window.actions_table["copy"].trigger()
    assert QGuiApplication.clipboard().text() == "Half way"
    person.press(Key.Key_End)
    person.window.actions_table["paste"].trigger()
    assert title.text() == "Half wayHalf way"
    person.press(Key.Key_Return)
    assert len(person.blueprint["SB1"].table) == 4


@pytest.mark.parametrize("form", ["json", "smsl", "yaml"])
def test_whole_sbs_come_in_from_the_text_of_any_form(sit: Sit, form: str) -> None:
    person = sit(HFSM)
    values = {"SB9": {"HEADER": {}, "State0": {"On": "State1"}, "State1": {}}}
    put(form_named(form).write(values))
    person.ctrl(Key.Key_V)
    assert list(person.blueprint.branches) == ["SB1", "SB2", "SB9"]
    assert person.window.session.branch == "SB9"
    assert person.steps() == ["Paste SB9"]


def test_a_whole_sb_is_copied_in_the_outline(sit: Sit) -> None:
    person = sit(HFSM)
    person.window.session.show_branch("SB2")
    tree = person.window.outline.tree
    tree.setFocus()
    person.ctrl(Key.Key_C)
    assert person.window.toast.words == "Copied SB2."
    person.ctrl(Key.Key_V)
    assert list(person.blueprint.branches) == ["SB1", "SB2", "SB3"]
    assert person.blueprint["SB3"].table == person.blueprint["SB2"].table
    tree.setFocus()
    person.ctrl(Key.Key_X)
    assert list(person.blueprint.branches) == ["SB1", "SB2"]
    assert person.steps() == ["Paste SB3", "Cut SB3"]


def test_text_that_is_no_smsl_is_refused(sit: Sit) -> None:
    person = sit(HFSM)
    for text, said in (("", "holds no text"), ("buy milk", "is no SMSL"), ('{"A": 3}', "is no")):
        put(text)
        person.ctrl(Key.Key_V)
        assert said in person.window.toast.words, text
    assert person.steps() == []


def test_a_file_without_sbs_takes_states_in(sit: Sit) -> None:
    person = sit(HFSM)
    person.select("SB1/State100")
    person.ctrl(Key.Key_C)
    other = sit()
    come(other)
    other.window.outline.delete_branch()
    assert not other.blueprint.branches
    other.window.canvas.setFocus()
    other.ctrl(Key.Key_V)
    assert list(other.blueprint["SB1"].table) == ["State100"]
    assert other.steps()[-1] == "Paste State100"


def test_states_that_are_pasted_ask_for_the_size_of_all_nodes_only_a_few_times(
    sit: Sit, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Once for each state would be slow: the time would grow with the square of their number."""
    person = sit()
    whole = Sheet.halves
    asked: list[int] = []

    def counted(sheet: Sheet, states: slice | int = slice(None)) -> Floats:
        if isinstance(states, slice):
            asked.append(1)
        return whole(sheet, states)

    monkeypatch.setattr(Sheet, "halves", counted)
    states = {f"State_{n:03}": {"go": f"State_{n // 2:03}"} for n in range(600)}
    put(json.dumps(states)[1:-1])
    person.window.canvas.setFocus()
    person.ctrl(Key.Key_V)
    assert len(person.blueprint["SB1"].table) == 600
    assert len(person.selected()) == 600
    assert len(asked) < 60
