"""What was seen when a drawing was saved is seen when it is opened, in every view of it."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from smsl_studio import read
from smsl_studio.graph.layout import place_states
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key = Qt.Key
Drawn = dict[str, tuple[float, float]]


def _drawn(person: Person) -> Drawn:
    """Where the states stand on the canvas, in tenths of a pixel as a file has them."""
    return {
        name: (round(x, 1), round(y, 1)) for name, (x, y) in person.window.canvas.positions.items()
    }


def _add_a_state(person: Person) -> None:
    person.window.actions_table["add_state"].trigger()
    field = QApplication.focusWidget()
    assert field is not None
    QTest.keyClick(field, Key.Key_Return)


def _move_a_state(person: Person) -> None:
    person.drag(person.place("SB1/State_ccc"), person.place("SB1/State_ccc") + QPoint(70, -40))


@pytest.mark.parametrize("change", [_add_a_state, _move_a_state])
def test_one_state_by_hand_leaves_all_others_where_they_were(
    sit: Sit, tmp_path: Path, change: object
) -> None:
    path = Path(shutil.copy(SAMPLES / "hanoi.json", tmp_path))
    person = sit(path)
    before = _drawn(person)
    assert callable(change)
    change(person)
    assert len(person.steps()) == 1
    seen = _drawn(person)
    changed = [name for name in seen if seen[name] != before.get(name)]
    assert len(changed) == 1
    person.ctrl(Key.Key_S)
    assert place_states(read(path)["SB1"]) == seen, "render and compare show the same"

    again = sit(path)
    assert _drawn(again) == seen
    again.ctrl(Key.Key_2)
    shown = again.window.run_pane.canvas.canvas.positions
    assert {name: (round(x, 1), round(y, 1)) for name, (x, y) in shown.items()} == seen


def test_the_run_shows_states_where_the_drawing_has_them_also_unsaved(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json")
    _add_a_state(person)
    person.ctrl(Key.Key_Z)
    person.select("SB1/State000")
    person.window.editor.rename(person.window.session.selection[0])
    field = QApplication.focusWidget()
    assert field is not None
    QTest.keyClick(field, Key.Key_A, Qt.KeyboardModifier.ControlModifier)
    QTest.keyClicks(field, "State999")
    QTest.keyClick(field, Key.Key_Return)
    order = sorted(_drawn(person).items(), key=lambda one: (one[1][0], one[0]))
    person.ctrl(Key.Key_2)
    shown = person.window.run_pane.canvas.canvas.positions
    assert [n for n, _ in sorted(shown.items(), key=lambda one: (one[1][0], one[0]))] == [
        n for n, _ in order
    ]
