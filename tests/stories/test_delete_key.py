"""Del, F2 and Ctrl+X act on the selection that Properties shows, for any keyboard focus."""

from __future__ import annotations

import json
from pathlib import Path

from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMenu

from smsl_studio.blueprint.address import Address
from smsl_studio.studio.features.draw.panels.outline_tree import line_of
from tests.stories.at_outline import shown
from tests.stories.conftest import Sit
from tests.stories.person import LEFT, SAMPLES, Person

Key = Qt.Key
HANOI = SAMPLES / "hanoi.json"


def _press(key: Qt.Key) -> None:
    """A key goes where the focus is, as it does under a person's hand."""
    focus = QApplication.focusWidget()
    assert focus is not None, "no widget has the keys"
    QTest.keyClick(focus, key)


def _click_line(person: Person, branch: str, digit: int | None = None) -> None:
    tree = person.window.outline.tree
    rect = tree.visualRect(tree.index_of(branch, digit))
    QTest.mouseClick(tree.viewport(), LEFT, pos=QPoint(rect.left() + 60, rect.center().y()))


def test_a_state_that_was_just_added_is_what_del_deletes(sit: Sit) -> None:
    person = sit(HANOI)
    person.window.outline.tree.setFocus()
    person.window.actions_table["add_state"].trigger()
    _press(Key.Key_Return)
    session = person.window.session
    assert len(session.blueprint["SB1"].table) == 28
    assert person.window.canvas.hasFocus()
    _press(Key.Key_Delete)
    assert len(session.blueprint["SB1"].table) == 27


def test_what_the_palette_found_is_in_view_and_is_what_del_and_f2_mean(sit: Sit) -> None:
    person = sit(HANOI)
    person.window.outline.tree.setFocus()
    person.window.canvas.zoom_to(1.5)
    person.ctrl(Key.Key_K)
    QTest.keyClicks(person.window.command_palette.field, "State_ccc")
    _press(Key.Key_Return)
    session, canvas = person.window.session, person.window.canvas
    assert session.selection == (Address("SB1", "State_ccc"),)
    assert canvas.hasFocus()
    rect = canvas.rect_of(session.selection[0])
    assert rect is not None
    person.until(lambda: canvas.viewport().rect().contains(canvas.mapFromScene(rect.center())))
    _press(Key.Key_F2)
    assert person.window.editor.field is not None, "F2 renames the state, not the SB"
    _press(Key.Key_Escape)
    _press(Key.Key_Delete)
    assert "State_ccc" not in session.blueprint["SB1"].table
    assert len(session.blueprint["SB1"].table) == 26


def test_del_after_f3_takes_the_finding_s_operation_and_no_state_branch(sit: Sit) -> None:
    person = sit(HANOI)
    person.until(lambda: len(person.window.findings.findings) > 0)
    person.window.outline.tree.setFocus()
    _press(Key.Key_F3)
    (found,) = person.window.session.selection
    assert found.operation
    _press(Key.Key_Delete)
    blueprint = person.window.session.blueprint
    assert len(blueprint["SB1"].table) == 27
    assert found.operation not in blueprint[found.branch].table[found.state]


def test_del_right_after_opening_deletes_nothing(sit: Sit) -> None:
    person = sit(HANOI)
    person.window.outline.tree.setFocus()
    person.window.open_path(SAMPLES / "hfsm.json")
    assert person.window.canvas.hasFocus()
    _press(Key.Key_Delete)
    assert list(person.window.session.blueprint.branches) == ["SB1", "SB2"]
    assert person.steps() == []


def test_with_a_selection_keys_in_the_outline_mean_the_selection(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json")
    session = person.window.session
    session.select([Address("SB1", next(iter(session.blueprint["SB1"].table)))])
    person.window.outline.tree.setFocus()
    QTest.keyClick(person.window.outline.tree, Key.Key_X, Qt.KeyboardModifier.ControlModifier)
    assert "SB1" in session.blueprint.branches
    assert person.steps()[-1].startswith("Cut State")


def test_del_on_a_fact_says_what_that_can_mean(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json")
    session = person.window.session
    base = session.blueprint["SB1"]
    ((digit, sub),) = base.subs.items()
    _click_line(person, "SB1", digit)
    assert session.fact == ("SB1", digit)
    assert person.window.properties.fact.isVisible()
    assert line_of(person.window.outline.tree.currentIndex()).digit == digit
    QTest.keyClick(person.window.outline.tree, Key.Key_Delete)
    assert person.steps() == []
    (menu,) = [one for one in QApplication.topLevelWidgets()
               if isinstance(one, QMenu) and one.isVisible()]  # fmt: skip
    words = [action.text() for action in menu.actions()]
    assert words[0] == f"Detach {sub} from {base.fact_name(digit)}"
    assert words[-1] == (
        "State100 and State110 would have the same facts. Delete one of them first."
    )
    assert not menu.actions()[-1].isEnabled()
    menu.actions()[0].trigger()
    menu.close()
    assert not session.blueprint["SB1"].subs
    assert "SB1" in session.blueprint.branches


def test_a_fact_beside_the_names_is_deleted_from_the_outline(sit: Sit, tmp_path: Path) -> None:
    branch = {
        "HEADER": {"INITIAL": "Idle", "ACTIVATING": "Done", "NUM_FACTS": 2},
        "_facts": {"0": {"name": "clamp"}, "1": {"name": "drill"}},
        "_states": {"Idle": {"facts": ["0", "0"]}, "Done": {"facts": ["1", "1"]}},
        "Idle": {"go": "Done"},
        "Done": {},
    }
    path = tmp_path / "words.json"
    path.write_text(json.dumps({"CELL": branch}, indent=1), "utf-8")
    person = sit(path)
    _click_line(person, "CELL", 1)
    QTest.keyClick(person.window.outline.tree, Key.Key_Delete)
    (menu,) = [one for one in QApplication.topLevelWidgets()
               if isinstance(one, QMenu) and one.isVisible()]  # fmt: skip
    last = menu.actions()[-1]
    assert last.text() == (
        "Delete the fact: “drill” is deleted. 2 states keep their names; its values beside them go."
    )
    last.trigger()
    menu.close()
    assert person.window.session.blueprint["CELL"].num_facts == 1
    assert person.steps() == ["Delete drill of CELL"]


def test_a_state_branch_that_is_deleted_is_named_and_can_be_taken_back(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json")
    session, toast = person.window.session, person.window.toast
    states = len(session.blueprint["SB2"].table)
    _click_line(person, "SB2")
    QTest.keyClick(person.window.outline.tree, Key.Key_Delete)
    assert "SB2" not in session.blueprint.branches
    assert toast.words == f"Deleted State Branch SB2 with {states} states."
    person.click(toast.button)
    assert "SB2" in session.blueprint.branches
    assert not toast.isVisible()
    assert person.window.outline.tree.hasFocus()


def test_arrows_in_the_outline_lead_the_canvas_along(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json")
    session, tree = person.window.session, person.window.outline.tree
    _click_line(person, "SB1")
    seen = []
    for _ in shown(tree):
        seen.append(session.fact or session.branch)
        QTest.keyClick(tree, Key.Key_Down)
    assert "SB2" in seen
    assert ("SB1", 0) in seen
    assert person.window.canvas.sheet is not None
    assert person.window.canvas.sheet.picture.branch.name == session.branch
