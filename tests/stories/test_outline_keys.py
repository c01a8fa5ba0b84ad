"""The keys on every kind of row of the outline: an SB, a fact, an import that failed."""

from __future__ import annotations

from pathlib import Path

import pytest
from PySide6.QtCore import QPoint, Qt, QTimer
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLineEdit, QMenu

from smsl_studio.blueprint import editing
from smsl_studio.studio.features.draw.panels.outline_tree import line_of
from tests.stories.at_outline import click_line, texts
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key = Qt.Key
HFSM = SAMPLES / "hfsm.json"


def click_fact(person: Person, branch: str, digit: int) -> None:
    tree = person.window.outline.tree
    rect = tree.visualRect(tree.index_of(branch, digit))
    QTest.mouseClick(
        tree.viewport(), Qt.MouseButton.LeftButton, pos=QPoint(rect.left() + 60, rect.center().y())
    )


def editor(person: Person) -> QLineEdit | None:
    """The field in which a name is edited in place."""
    found = QApplication.focusWidget()
    inside = found is not None and person.window.outline.tree.isAncestorOf(found)
    return found if inside and isinstance(found, QLineEdit) else None


@pytest.mark.parametrize("branch", ["SB1", "SB2"])
def test_f2_on_a_fact_edits_its_name_in_place(sit: Sit, branch: str) -> None:
    person = sit(HFSM)
    tree, session = person.window.outline.tree, person.window.session
    click_fact(person, branch, 0)
    person.press(Key.Key_F2)
    field = editor(person)
    assert field is not None
    assert field.accessibleName() == "Name of Fact 1, digit 0"
    person.type("Speed")
    person.press(Key.Key_Return)
    person.until(lambda: "Speed" in texts(tree))
    assert session.blueprint[branch].fact_name(0) == "Speed"
    assert person.steps() == ["Name digit 0 “Speed”"]
    assert session.fact == (branch, 0)
    assert person.window.properties.fact.name.text() == "Speed"
    # The name that stands there without being written is not written either.
    person.press(Key.Key_F2)
    person.type("Fact 1")
    person.press(Key.Key_Return)
    assert session.blueprint[branch].fact_note(0) is None


def test_escape_and_the_same_name_leave_a_fact_as_it_was(sit: Sit) -> None:
    person = sit(HFSM)
    click_fact(person, "SB1", 0)
    person.press(Key.Key_F2)
    person.type("Speed")
    person.press(Key.Key_Escape)
    assert editor(person) is None
    person.press(Key.Key_F2)
    person.press(Key.Key_Return)
    assert person.steps() == []


def test_letters_choose_no_row_so_that_del_means_what_was_chosen(sit: Sit) -> None:
    person = sit(HFSM)
    tree, session = person.window.outline.tree, person.window.session
    click_fact(person, "SB2", 0)
    for letters in ("Speed", "S", "f"):
        person.type(letters)
        assert line_of(tree.currentIndex()).digit == 0
        assert session.fact == ("SB2", 0)
    person.press(Key.Key_Delete)
    assert set(session.blueprint.branches) == {"SB1", "SB2"}
    (menu,) = [one for one in QApplication.topLevelWidgets()
               if isinstance(one, QMenu) and one.isVisible()]  # fmt: skip
    menu.close()


def test_letters_in_the_history_undo_nothing(sit: Sit) -> None:
    person = sit(HFSM)
    click_fact(person, "SB1", 0)
    for name in ("Speed", "Way"):
        person.press(Key.Key_F2)
        person.type(name)
        person.press(Key.Key_Return)
    person.window.show_tab("History")
    person.window.history.setFocus()
    person.type("As")
    assert person.window.session.history.index() == 2


def test_the_menu_of_a_fact_s_row_says_what_the_keys_mean_there(sit: Sit) -> None:
    person = sit(HFSM)
    outline, seen, keys = person.window.outline, list[str](), list[str]()
    click_fact(person, "SB1", 0)
    name = person.blueprint["SB1"].fact_name(0)

    def read() -> None:
        menu = QApplication.activePopupWidget()
        assert isinstance(menu, QMenu)
        seen.extend(action.text() for action in menu.actions())
        keys.extend(action.shortcut().toString() for action in menu.actions())
        menu.close()

    QTimer.singleShot(0, read)
    rect = outline.tree.visualRect(outline.tree.currentIndex())
    outline.tree.customContextMenuRequested.emit(rect.center())
    assert seen == ["Add State Branch", f"Rename {name}", f"Delete from {name}…"]
    assert keys == ["", "F2", "Del"]
    person.come_back()


def test_a_selected_fact_that_loses_its_row_leaves_the_row_of_its_state_branch(
    sit: Sit, tmp_path: Path
) -> None:
    path = tmp_path / "two.json"
    path.write_text('{"SB1": {"State_0": {}}, "SB2": {"State_0": {}, "State_1": {}}}')
    person = sit(path)
    tree, session = person.window.outline.tree, person.window.session
    click_fact(person, "SB2", 0)
    # This name has no digits, so no row tells a fact of this SB any more.
    session.edit("Add", lambda bp: editing.add_state(bp, "SB2", "New"))
    person.until(lambda: not tree.index_of("SB2", 0).isValid())
    assert session.fact == ("SB2", 0)
    rows = [line_of(one) for one in tree.selectedIndexes()]
    assert [(one.branch, one.digit) for one in rows] == [("SB2", None)]
    # What the keys mean is what is marked.
    person.press(Key.Key_F2)
    field = editor(person)
    assert field is not None
    assert field.accessibleName() == "Name of the State Branch"
    person.press(Key.Key_Escape)
    # But Properties show the fact, and nobody has chosen the State Branch: it is not deleted.
    tree.setFocus()
    person.press(Key.Key_Delete)
    assert "SB2" in session.blueprint.branches
    assert "has no line here" in person.window.toast.words
    # And back: the fact has its row again.
    session.history.undo()
    person.until(lambda: tree.index_of("SB2", 0).isValid())
    rows = [line_of(one) for one in tree.selectedIndexes()]
    assert [(one.branch, one.digit) for one in rows] == [("SB2", 0)]


def test_keys_on_an_import_that_failed_touch_no_state_branch(sit: Sit, tmp_path: Path) -> None:
    path = tmp_path / "outer.json"
    path.write_text('{"_imports": ["missing.json"], "SB1": {"State_0": {}}}')
    person = sit(path)
    tree = person.window.outline.tree
    click_line(tree, "missing.json")
    assert line_of(tree.currentIndex()).fault
    for key in (Key.Key_F2, Key.Key_Delete):
        person.press(key)
        assert list(person.blueprint.branches) == ["SB1"]
        assert "no State Branch" in person.window.toast.words
        assert editor(person) is None
        assert line_of(tree.currentIndex()).fault
    person.press(Key.Key_Up)
    person.press(Key.Key_Down)
    person.press(Key.Key_Delete)
    assert list(person.blueprint.branches) == ["SB1"]
