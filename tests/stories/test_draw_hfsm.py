"""The paper's hFSM, drawn by hand from an empty window, means the same as the sample."""

from __future__ import annotations

from pathlib import Path

import pytest
from PySide6.QtCore import QPoint, Qt

from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.smsl.files import read_document
from smsl_studio.studio.document.files.dialogs import Dialogs
from tests.stories.conftest import Sit
from tests.stories.person import Person, sample

Key = Qt.Key


def name_it(person: Person, name: str) -> None:
    """Type over the suggested name and press Enter."""
    person.type(name)
    person.press(Key.Key_Return)


def draw_first_branch(person: Person) -> None:
    header = person.window.properties.header
    person.write(header.num_facts, "3")
    person.double_click_canvas(person.window.canvas.rect().center() - QPoint(260, 0))
    name_it(person, "State000")
    # Dropped on empty canvas, the operation brings its target along.
    person.drag_from_handle("SB1/State000", person.place("SB1/State000") + QPoint(220, 0))
    person.type("Operation000")
    person.press(Key.Key_Tab)
    name_it(person, "State100")
    # The same by keys alone: Tab, two names, Enter.
    person.select("SB1/State100")
    person.press(Key.Key_Tab)
    person.type("Operation100A")
    person.press(Key.Key_Tab)
    name_it(person, "State110")
    person.double_click_canvas(person.place("SB1/State110") + QPoint(0, 160))
    name_it(person, "State111")
    # From handle to handle, then names by F2.
    person.drag_from_handle("SB1/State110", person.place("SB1/State111"))
    name_it(person, "Operation110B")
    person.drag_from_handle("SB1/State100", person.place("SB1/State111"))
    name_it(person, "Other")
    person.press(Key.Key_F2)
    name_it(person, "Operation100B")
    person.drag_from_handle("SB1/State110", person.place("SB1/State100"))
    name_it(person, "Operation110A")
    person.click_canvas(QPoint(30, 300))
    person.choose(header.initial, "State000")
    # State111 was put beside the others, so the activating state has stayed what it was.
    person.choose(header.activating, "State111")


def draw_second_branch(person: Person) -> None:
    person.click(person.window.outline.add_button)
    name_it(person, "SB2")
    header = person.window.properties.header
    person.write(header.num_facts, "1")
    person.double_click_canvas(person.window.canvas.rect().center())
    name_it(person, "State0")
    person.drag_from_handle("SB2/State0", person.place("SB2/State0") + QPoint(220, 0))
    person.type("Operation0")
    person.press(Key.Key_Tab)
    name_it(person, "State1")
    person.drag_from_handle("SB2/State1", person.place("SB2/State0"))
    name_it(person, "Operation1")
    person.click_canvas(QPoint(30, 300))
    person.choose(header.initial, "State0")
    person.choose(header.activating, "State1")


def test_hfsm_is_drawn_saved_and_equal(
    sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    person = sit()
    draw_first_branch(person)
    draw_second_branch(person)
    tree = person.window.outline.tree
    person.click_row(tree, "SB1")
    assert person.window.session.branch == "SB1"
    person.choose(person.window.properties.header.facts[1].sub, "SB2")
    target = tmp_path / "drawn.json"
    monkeypatch.setattr(Dialogs, "file_to_save", lambda *_: target)
    person.ctrl(Key.Key_S)
    assert not person.window.session.edited
    drawn = read_blueprint(read_document(target))
    assert drawn == sample("hfsm.json")
    assert [list(branch.table) for branch in drawn] == [
        list(branch.table) for branch in sample("hfsm.json")
    ]
    steps = person.steps()
    for _ in steps:
        person.ctrl(Key.Key_Z)
    assert person.window.session.blueprint["SB1"].table == {}
    assert person.window.menu_row.title == "drawn.json edited"
