"""A drawing opens as it was when it was saved, in every view of it."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from smsl_studio import read
from smsl_studio.blueprint import editing
from smsl_studio.graph.layout import place_states
from tests.stories.at_run import AtRun
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person, address

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
    shown = again.window.features.run.pane.canvas.canvas.positions
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
    shown = person.window.features.run.pane.canvas.canvas.positions
    assert [n for n, _ in sorted(shown.items(), key=lambda one: (one[1][0], one[0]))] == [
        n for n, _ in order
    ]


def _add_an_operation(person: Person) -> None:
    person.select("SB1/State_0", "SB1/State_2")
    person.window.actions_table["connect"].trigger()
    _type_a_name("Op_far")


def _delete_a_state(person: Person) -> None:
    person.select("SB1/State_1")
    person.press(Key.Key_Delete)


def _rename_a_state(person: Person) -> None:
    person.select("SB1/State_1")
    person.window.actions_table["rename"].trigger()
    _type_a_name("Other")


def _type_a_name(name: str) -> None:
    field = QApplication.focusWidget()
    assert field is not None
    QTest.keyClick(field, Key.Key_A, Qt.KeyboardModifier.ControlModifier)
    QTest.keyClicks(field, name)
    QTest.keyClick(field, Key.Key_Return)


CHAIN = {
    "State_0": {"Op_0": "State_1"},
    "State_1": {"Op_1": "State_2"},
    "State_2": {"Op_2": "State_3"},
    "State_3": {},
}


@pytest.mark.parametrize("change", [_add_an_operation, _delete_a_state, _rename_a_state])
@pytest.mark.parametrize("by_hand", [{}, {"State_3": [900, 300]}])
def test_an_edit_that_would_be_laid_out_in_another_way_writes_what_is_seen(
    sit: Sit, tmp_path: Path, change: Callable[[Person], None], by_hand: dict[str, list[int]]
) -> None:
    path = tmp_path / "chain.json"
    path.write_text(json.dumps({"SB1": {**CHAIN, "_layout": by_hand}}), encoding="utf-8")
    person = sit(path)
    change(person)
    assert len(person.steps()) == 1
    seen = _drawn(person)
    person.ctrl(Key.Key_S)
    assert {n: (round(x, 1), round(y, 1)) for n, (x, y) in place_states(read(path)["SB1"]).items()
            } == seen  # fmt: skip


def test_a_new_name_leaves_a_drawing_that_nobody_arranged_without_places(
    sit: Sit, tmp_path: Path
) -> None:
    path = tmp_path / "chain.json"
    path.write_text(json.dumps({"SB1": CHAIN}), encoding="utf-8")
    person = sit(path)
    _rename_a_state(person)
    person.ctrl(Key.Key_S)
    assert "_layout" not in path.read_text("utf-8")


def test_a_state_branch_that_is_renamed_keeps_its_picture(sit: Sit, tmp_path: Path) -> None:
    path = tmp_path / "chain.json"
    path.write_text(json.dumps({"SB1": CHAIN}), encoding="utf-8")
    person = sit(path)
    _delete_a_state(person)
    person.window.session.history.undo()
    seen = _drawn(person)
    person.window.session.edit("Rename", lambda bp: editing.rename(bp, address("SB1"), "Chain"))
    assert _drawn(person) == seen
    person.ctrl(Key.Key_S)
    assert place_states(read(path)["Chain"]) == seen


def test_a_state_moved_during_a_run_is_seen_there_too(sit: Sit, tmp_path: Path) -> None:
    person = sit(Path(shutil.copy(SAMPLES / "hfsm.json", tmp_path)))
    at_run = AtRun(person)
    at_run.choose(world="table")
    person.press(Key.Key_F10)
    at_run.until_phase("Paused")
    person.ctrl(Key.Key_1)
    branch = person.window.session.branch
    state = f"{branch}/{next(iter(person.blueprint[branch].table))}"
    person.drag(person.place(state), person.place(state) + QPoint(60, 40))
    seen = _drawn(person)
    person.ctrl(Key.Key_2)
    canvas = at_run.pane.canvas
    assert canvas.branch == branch
    assert {n: (round(x, 1), round(y, 1)) for n, (x, y) in canvas.canvas.positions.items()} == seen
