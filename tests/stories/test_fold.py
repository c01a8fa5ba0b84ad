"""The lower panel is folded to its tabs, and the drawing gets its room."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from smsl_studio.studio.base.tabs import HEIGHT
from smsl_studio.studio.shell.window import Window
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

HFSM = SAMPLES / "hfsm.json"
SIZE = (1280, 800)


@pytest.fixture
def person(sit: Sit) -> Person:
    return sit(HFSM, SIZE)


def share(person: Person) -> float:
    """The share of the canvas in the window."""
    canvas, window = person.window.canvas, person.window
    return canvas.width() * canvas.height() / (window.width() * window.height())


def test_the_button_folds_the_panel_and_a_click_on_a_tab_unfolds_it(person: Person) -> None:
    docks = person.window.docks
    before, height = share(person), docks.bottom.height()
    person.click(docks.fold.button)
    person.until(lambda: docks.bottom.height() == HEIGHT)
    person.until(lambda: share(person) > 0.47)
    assert before < 0.37
    assert not person.window.findings.isVisible()
    assert docks.bottom_tabs.bar.isVisible()
    assert docks.fold.button.accessibleName() == "Unfold"
    bar = docks.bottom_tabs.bar
    history = [bar.tabText(at) for at in range(bar.count())].index("History")
    QTest.mouseClick(bar, Qt.MouseButton.LeftButton, pos=bar.tabRect(history).center())
    person.until(lambda: docks.bottom.height() == height)
    assert share(person) == before
    assert person.window.history.isVisible()


def test_a_panel_that_is_asked_for_unfolds_and_a_new_finding_does_not(person: Person) -> None:
    docks, actions = person.window.docks, person.window.actions_table
    actions["fold_panel"].trigger()
    assert actions["fold_panel"].isChecked()
    person.select("SB1/State111")
    person.press(Qt.Key.Key_Delete)
    person.until_inspected()
    assert docks.bottom_folded()
    person.press(Qt.Key.Key_H, [Qt.KeyboardModifier.ControlModifier])
    assert not docks.bottom_folded()
    person.until(person.window.history.isVisible)


def test_it_is_remembered_and_other_modes_do_not_change_it(person: Person) -> None:
    window = person.window
    window.actions_table["fold_panel"].trigger()
    person.ctrl(Qt.Key.Key_2)
    person.ctrl(Qt.Key.Key_1)
    person.until(lambda: window.docks.bottom.height() == HEIGHT)
    assert window.close()
    again = Window(person.windows)
    again.show()
    again.resize(*SIZE)
    assert again.docks.bottom_folded()
    person.until(lambda: again.docks.bottom.height() == HEIGHT)
    again.docks.fold_bottom()
    person.until(lambda: again.docks.bottom.height() > 2 * HEIGHT)
    again.close()
