"""What the window shows and says while one draws is what is so."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMenu

from smsl_studio.studio.base.canvas.gesture_layer import DrawnOperation
from smsl_studio.studio.document.files.dialogs import Dialogs
from smsl_studio.studio.features.draw.canvas.connect_card import ConnectCard
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key = Qt.Key


@pytest.fixture
def person(sit: Sit, tmp_path: Path) -> Person:
    return sit(Path(shutil.copy(SAMPLES / "hfsm.json", tmp_path / "hfsm.json")))


def is_new(person: Person) -> bool:
    """Whether the line that is being named leads to a new state."""
    drawn = person.window.canvas.gestures.drawn
    assert isinstance(drawn, DrawnOperation)
    return drawn.ghost


def test_a_target_that_is_there_is_shown_as_it_is(person: Person) -> None:
    person.select("SB1/State000")
    person.ctrl(Key.Key_E)
    card = person.window.features.draw.editor.field
    assert isinstance(card, ConnectCard)
    assert is_new(person)
    person.click(card.target)
    card.target.selectAll()
    person.type("State110")
    assert not is_new(person)
    person.type("9")
    assert is_new(person)
    person.press(Key.Key_Backspace)
    assert not is_new(person)
    person.press(Key.Key_Escape)


def test_the_tip_of_a_menu_goes_with_the_menu(person: Person) -> None:
    line = person.window.status_line
    menu = next(one for one in person.window.menu_row.menus.findChildren(QMenu)
                if any(row.statusTip() for row in one.actions()))  # fmt: skip
    for ending in (Key.Key_Escape, None):
        menu.popup(person.window.mapToGlobal(person.window.rect().center()))
        person.until(menu.isVisible)
        row = next(one for one in menu.actions() if one.statusTip() and one.isEnabled())
        menu.setActiveAction(row)
        person.window.statusBar().showMessage(row.statusTip())
        assert line.currentMessage() == row.statusTip()
        if ending is None:
            menu.close()
        else:
            QTest.keyClick(menu, ending)
        person.until(lambda: QApplication.activePopupWidget() is None)
        assert line.currentMessage() == ""


def test_a_name_that_says_no_form_says_which_form_it_got(
    person: Person, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Dialogs, "file_to_save", lambda *_: tmp_path / "foo.txt")
    person.press(
        Key.Key_S, [Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier]
    )
    assert (tmp_path / "foo.txt").exists()
    assert "foo.txt as JSON" in person.window.toast.words
