"""A table from a spreadsheet is pasted onto the canvas: what it brings is told first."""

from __future__ import annotations

from collections.abc import Iterator
from threading import Event
from typing import Any

import pytest
from PySide6.QtCore import QMimeData, QPoint, QPointF, Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QApplication

from smsl_studio.blueprint import editing
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key = Qt.Key
HFSM = SAMPLES / "hfsm.json"
TABLE = "State\tOperation\tTarget\nIdle\tstart\tReady\nReady\tlift\tUp\nUp\tdrop\tIdle\n"


@pytest.fixture(autouse=True)
def empty_clipboard(qapp: QGuiApplication) -> Iterator[None]:
    """What one story leaves on the clipboard is not there in the next."""
    yield
    QGuiApplication.clipboard().clear()


@pytest.fixture
def gate(monkeypatch: pytest.MonkeyPatch) -> Iterator[Event]:
    """A table is not put in before this is set, however quick the machine is."""
    gate, put_in = Event(), editing.paste_states

    def paste_states(*given: Any) -> Any:
        gate.wait()
        return put_in(*given)

    monkeypatch.setattr(editing, "paste_states", paste_states)
    yield gate
    gate.set()


def paste(person: Person, text: str) -> None:
    """Copy a text in another program, and paste it."""
    data = QMimeData()
    data.setText(text)
    QGuiApplication.clipboard().setMimeData(data)
    person.window.canvas.setFocus()
    person.ctrl(Key.Key_V)


def test_a_table_is_told_first_and_pasted_as_one_step(sit: Sit) -> None:
    person = sit()
    before = person.blueprint.document.text
    paste(person, TABLE)
    card = person.window.clipping.table_card
    assert card.isVisible()
    assert card.words.text() == "The table brings 3 new states and 3 new operations to SB1."
    assert [name.text() for name in card.names if name.isVisible()] == [
        "Idle: start → Ready", "Ready: lift → Up", "Up: drop → Idle"
    ]  # fmt: skip
    assert person.blueprint.document.text == before
    assert card.agree.hasFocus()
    person.press(Key.Key_Return)
    assert not card.isVisible()
    assert person.blueprint["SB1"].table == {
        "Idle": {"start": "Ready"}, "Ready": {"lift": "Up"}, "Up": {"drop": "Idle"}
    }  # fmt: skip
    assert person.selected() == ["SB1/Idle", "SB1/Ready", "SB1/Up"]
    assert person.steps() == ["Paste 3 states and 3 operations"]
    assert person.window.canvas.hasFocus()
    canvas = person.window.canvas
    places = [QPointF(*canvas.positions[state]) for state in ("Idle", "Ready", "Up")]
    person.until(lambda: all(canvas.seen.contains(place) for place in places))
    person.ctrl(Key.Key_Z)
    assert person.blueprint.document.text == before


def test_a_table_adds_to_the_states_that_stand(sit: Sit) -> None:
    person = sit(HFSM)
    before = person.blueprint.document.text
    places = dict(person.window.canvas.positions)
    paste(person, "State100\tOperation100A\tState110\nState100\tgo on\tState101\n")
    card = person.window.clipping.table_card
    assert card.words.text() == (
        "The table brings 1 new state and 1 new operation to SB1. 1 operation is there already."
    )
    person.click(card.agree)
    assert person.blueprint["SB1"].table["State100"]["go on"] == "State101"
    shown = person.window.canvas.positions
    assert all(abs(shown[s][0] - x) < 0.1 for s, (x, _) in places.items()), "the others stay"
    person.ctrl(Key.Key_Z)
    assert person.blueprint.document.text == before


def test_faults_are_told_by_row_and_escape_closes(sit: Sit) -> None:
    person = sit(HFSM)
    paste(person, "State100\tgo\nState110\tgo\tState999\n\tgo\tState000")
    card = person.window.clipping.table_card
    assert "Row" not in person.window.toast.words
    assert "row 1: an operation without a target; row 3: no state" in card.words.text()
    assert not card.agree.isEnabled()
    assert card.cancel.hasFocus()
    person.press(Key.Key_Escape)
    assert not card.isVisible()
    assert person.window.canvas.hasFocus()
    assert person.steps() == []


def test_keys_at_the_card_do_not_reach_the_drawing(sit: Sit) -> None:
    person = sit(HFSM)
    person.select("SB1/State100")
    paste(person, TABLE)
    card = person.window.clipping.table_card
    assert card.isAncestorOf(QApplication.focusWidget() or person.window)
    person.press(Key.Key_Delete)
    assert person.steps() == []
    person.click_canvas(QPoint(30, 400))
    assert not card.isVisible()


def test_a_table_in_a_file_without_sbs_makes_one(sit: Sit) -> None:
    person = sit()
    person.window.outline.delete_branch()
    paste(person, TABLE)
    person.press(Key.Key_Return)
    assert list(person.blueprint["SB1"].table) == ["Idle", "Ready", "Up"]
    assert person.window.session.branch == "SB1"


def test_ten_megabytes_are_answered_at_once(sit: Sit) -> None:
    person = sit(HFSM)
    row, state = "State_{0:07}\tgo\tState_{0:07}\n", '"State_{0:07}": {{"go": "State_0000000"}},\n'
    for text in (row, state):
        paste(person, "".join(map(text.format, range(300_000))))
        assert "more text than is pasted at once" in person.window.toast.words
    card = person.window.clipping.table_card
    assert not card.isVisible()
    paste(person, "".join(map(row.format, range(20_000))))
    assert "has more than 300,000 characters" in card.words.text()
    person.press(Key.Key_Escape)
    assert person.steps() == []


def test_states_copied_from_the_source_of_another_file_are_pasted(sit: Sit) -> None:
    person = sit(HFSM)
    paste(person, '"State010": {\n    "Operation010": "State110"\n},\n')
    assert person.blueprint["SB1"].table["State010"] == {"Operation010": "State110"}
    assert person.selected() == ["SB1/State010"]
    assert person.steps() == ["Paste State010"]


def long_table() -> str:
    return "".join(f"State_{at}\tgo\tState_{at + 1}\n" for at in range(3_000))


def test_a_long_table_is_pasted_beside_the_window_as_one_step(sit: Sit, gate: Event) -> None:
    person = sit()
    before = person.blueprint.document.text
    paste(person, long_table())
    card = person.window.clipping.table_card
    assert card.words.text().startswith("The table brings 3,001 new states and 3,000")
    person.press(Key.Key_Return)
    assert card.isVisible(), "it can be called off"
    assert card.words.text().startswith("The table is being pasted.")
    assert card.cancel.hasFocus()
    assert not card.agree.isEnabled()
    assert person.blueprint.document.text == before
    gate.set()
    person.until(lambda: not card.isVisible())
    assert len(person.blueprint["SB1"].table) == 3_001
    assert person.steps() == ["Paste 3,001 states and 3,000 operations"]
    assert person.window.canvas.hasFocus()
    person.ctrl(Key.Key_Z)
    assert person.blueprint.document.text == before


@pytest.mark.parametrize("way", ["escape", "edit", "undo", "close"])
def test_a_long_paste_is_called_off(sit: Sit, gate: Event, way: str) -> None:
    person = sit()
    window = person.window
    window.session.edit("Add", lambda bp: editing.add_branch(bp, "SB2"))
    steps, before = person.steps(), person.blueprint.document.text
    paste(person, long_table())
    clipping = window.clipping
    person.press(Key.Key_Return)
    assert clipping.table_card.isVisible()
    if way == "escape":
        person.press(Key.Key_Escape)
    elif way == "edit":
        window.session.edit("Add", lambda bp: editing.add_branch(bp, "SB3"))
    elif way == "undo":
        window.session.history.undo()
    else:
        window.features.stop()
    after = person.blueprint.document.text
    assert way == "close" or not clipping.table_card.isVisible()
    gate.set()
    clipping.finish()
    QApplication.processEvents()
    assert person.blueprint.document.text == after
    assert (person.steps() == steps) is (way != "edit")
    assert (after == before) is (way in ("escape", "close"))
