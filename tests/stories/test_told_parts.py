"""Parts that come and go are in the tree of assistive tools, and tell their names and focus."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QAccessible, QAccessibleEvent
from PySide6.QtWidgets import QApplication

from smsl_studio.studio.base import announcement
from smsl_studio.studio.features.draw.find.palette import Palette
from smsl_studio.studio.shell import accessible_focus
from smsl_studio.studio.shell.accessible_factory import install
from tests.stories.conftest import Sit, reader
from tests.stories.person import SAMPLES

Key, NAME = Qt.Key, QAccessible.Text.Name
HFSM = SAMPLES / "hfsm.json"
Told = list[tuple[str, str]]


@pytest.fixture(autouse=True)
def _tree(qapp: QApplication) -> None:
    """The program installs it when it starts."""
    install(qapp)


@pytest.fixture
def told(monkeypatch: pytest.MonkeyPatch) -> Told:
    """Every event that a screen reader gets from the window itself: its kind, and of what."""
    found: Told = []

    def hear(event: QAccessibleEvent) -> None:
        """Keep the kind of an event, and the name of its object."""
        found.append((event.type().name, event.accessibleInterface().text(NAME)))

    listener = reader(hear)
    monkeypatch.setattr(announcement, "QAccessible", listener)
    monkeypatch.setattr(accessible_focus, "QAccessible", listener)
    return found


@pytest.mark.parametrize(("key", "form", "fields"), [
    (Key.Key_Slash, "New operation", ["Operation", "Target state"]),
    (Key.Key_F2, "Name", ["State"]),
])  # fmt: skip
def test_the_form_over_the_drawing_is_a_child_of_the_canvas(
    sit: Sit, key: Qt.Key, form: str, fields: list[str]
) -> None:
    person = sit(HFSM)
    canvas = QAccessible.queryAccessibleInterface(person.window.canvas)
    states = canvas.childCount()
    person.select("SB1/State110")
    person.press(key)
    assert canvas.childCount() == states + 1
    shown = canvas.child(states)
    assert shown.text(NAME) == form
    assert canvas.indexOfChild(shown) == states
    below = [shown.child(at) for at in range(shown.childCount())]
    edits = [one.text(NAME) for one in below if one.role() == QAccessible.Role.EditableText]
    assert edits == fields
    person.press(Key.Key_Escape)
    assert canvas.childCount() == states
    assert canvas.child(states) is None


def test_a_list_that_gets_the_focus_tells_its_row(sit: Sit, told: Told) -> None:
    person = sit(HFSM)
    person.until_inspected()
    window = person.window
    rows = window.findings.list
    rows.setCurrentIndex(rows.model().index(1, 0))
    expected = QAccessible.queryAccessibleInterface(rows).child(1).text(NAME)
    told.clear()
    rows.setFocus()
    person.until(lambda: ("Focus", expected) in told)
    person.select("SB1/State110")
    window.outline.tree.setFocus()
    told.clear()
    window.canvas.setFocus()
    person.until(lambda: bool(told))
    assert told[-1][0] == "Focus"
    assert told[-1][1].startswith("State110, selected")


def test_a_row_of_tabs_tells_that_its_name_is_another(sit: Sit, told: Told) -> None:
    person = sit(HFSM)
    bar = person.window.docks.bottom_tabs.bar
    told.clear()
    person.window.show_tab("History")
    assert ("NameChanged", QAccessible.queryAccessibleInterface(bar).text(NAME)) in told


def test_the_search_for_commands_gives_the_focus_straight_back(sit: Sit) -> None:
    person = sit(HFSM)
    person.ctrl(Key.Key_K)
    palette = person.window.findChild(Palette)
    assert palette is not None
    assert palette.isVisible()
    had = []
    application = QApplication.instance()
    assert isinstance(application, QApplication)
    application.focusChanged.connect(lambda _, now: had.append(now))
    person.press(Key.Key_Escape)
    person.until(person.window.canvas.hasFocus)
    assert had == [person.window.canvas]
    assert not palette.isVisible()


def test_the_first_child_of_a_tree_is_its_heading(sit: Sit) -> None:
    person = sit(HFSM)
    tree = QAccessible.queryAccessibleInterface(person.window.outline.tree)
    head = tree.child(0)
    assert head.text(NAME) == tree.text(NAME)
    assert head.role() == QAccessible.Role.ColumnHeader
    assert head.state().invisible
    assert tree.indexOfChild(head) == 0


def test_a_reader_can_give_the_focus_to_a_state_and_an_operation(sit: Sit) -> None:
    person = sit(HFSM)
    person.window.outline.tree.setFocus()
    canvas = QAccessible.queryAccessibleInterface(person.window.canvas)
    state = canvas.child(1)
    for part in (state.child(0), state):
        assert "SetFocus" in part.actionInterface().actionNames()
        part.actionInterface().doAction("SetFocus")
        assert person.window.canvas.hasFocus()
        assert part.state().focused
