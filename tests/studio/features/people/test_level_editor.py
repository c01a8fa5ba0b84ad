"""The level editor: its rows, the declarations and where they come from, and two ways to set
them."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.editing import delete, set_levels, set_note
from smsl_studio.blueprint.levels import Levels
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.people.level_editor import LevelEditor
from smsl_studio.studio.features.people.level_rows import level_rows
from smsl_studio.studio.running.next_levels import NextLevels
from tests.stories.person import sample


@pytest.fixture
def session(qtbot: QtBot) -> Session:
    return Session(sample("three-roots.json"))


def _editor(qtbot: QtBot, session: Session) -> LevelEditor:
    editor = LevelEditor(session, NextLevels(session))
    qtbot.addWidget(editor)
    editor.show()
    return editor


def _mark(editor: LevelEditor, *keys: str) -> None:
    editor.table.clearSelection()
    for at, row in enumerate(editor.model.rows):
        if row.key in keys:
            editor.table.selectionModel().select(
                editor.model.index(at, 0),
                editor.table.selectionModel().SelectionFlag.Select
                | editor.table.selectionModel().SelectionFlag.Rows,
            )


def test_rows_say_what_is_declared_and_where(session: Session) -> None:
    blueprint = set_levels(session.blueprint, {"supervision": "human", "TOOLPLAN/0": "shared"})
    blueprint = set_note(blueprint, "ROBOT", "_operations", "SwitchOn", {"actor": "human"})
    blueprint = set_note(blueprint, "ROBOT", "_facts", "1", {"aggregation": "human"})
    rows = {row.key: row for row in level_rows(blueprint)}
    found = {key: (rows[key].declared, rows[key].source) for key in (
        "inspection", "supervision", "generation", "TOOLPLAN/0", "TOOLPLAN/1", "ROBOT/1",
        "ROBOT/SwitchOn",
    )}  # fmt: skip
    assert found == {
        "inspection": ("automatic", "default"),
        "supervision": ("human", "_levels"),
        "generation": ("shared", "default"),
        "TOOLPLAN/0": ("shared", "_levels"),
        "TOOLPLAN/1": ("automatic", "default"),
        "ROBOT/1": ("human", "aggregation"),
        "ROBOT/SwitchOn": ("human", "who acts"),
    }
    assert "REGISTRATION/1" not in rows


def test_edges_have_rows_where_those_of_a_name_differ(session: Session) -> None:
    plain = level_rows(session.blueprint)
    assert {row.kind for row in plain} == {"layer", "fact", "operation"}
    edge = "TOOLPLAN/State00/ChooseEntry"
    rows = {row.key: row for row in level_rows(set_levels(session.blueprint, {edge: "human"}))}
    assert rows["TOOLPLAN/ChooseEntry"].declared == "human and automatic"
    assert rows[edge].source == "_levels"
    assert rows["TOOLPLAN/State01/ChooseEntry"].declared == "automatic"
    assert len(level_rows(session.blueprint, each_edge=True)) > len(plain)


def test_every_key_can_be_set(session: Session) -> None:
    rows = level_rows(session.blueprint, each_edge=True)
    Levels(session.blueprint, {row.key: "shared" for row in rows})


def test_what_is_chosen_counts_for_the_next_run(qtbot: QtBot, session: Session) -> None:
    editor = _editor(qtbot, session)
    assert not editor.use_button.isEnabled()
    assert not editor.buttons["human"].isEnabled()
    _mark(editor, "TOOLPLAN/ChooseEntry", "inspection")
    editor.buttons["human"].click()
    editor.use_button.click()
    levels = editor._levels
    assert levels.set == {"TOOLPLAN/ChooseEntry": "human", "inspection": "human"}
    assert session.blueprint.levels == {}
    again = LevelEditor(session, levels)
    qtbot.addWidget(again)
    again.show()
    _mark(again, "inspection")
    again.buttons[""].click()
    again.use_button.click()
    assert levels.set == {"TOOLPLAN/ChooseEntry": "human"}


def test_what_is_chosen_is_written_as_one_step_and_taken_back(
    qtbot: QtBot, session: Session
) -> None:
    editor = _editor(qtbot, session)
    _mark(editor, "TOOLPLAN/ChooseEntry", "ROBOT/1")
    editor.buttons["shared"].click()
    editor.write_button.click()
    assert session.blueprint.levels == {"TOOLPLAN/ChooseEntry": "shared", "ROBOT/1": "shared"}
    assert session.history.count() == 1
    session.history.undo()
    assert session.blueprint.levels == {}


def test_what_stands_in_the_file_is_taken_out_as_one_step(qtbot: QtBot, session: Session) -> None:
    session.edit("Set", lambda bp: set_levels(bp, {"supervision": "human", "ROBOT/1": "shared"}))
    editor = _editor(qtbot, session)
    _mark(editor, "TOOLPLAN/ChooseEntry")
    assert not editor.out_button.isEnabled()
    _mark(editor, "supervision", "TOOLPLAN/ChooseEntry")
    editor.out_button.click()
    assert editor.model.chosen == {"supervision": "taken out"}
    assert not editor.use_button.isEnabled(), "a run that begins now could not obey it"
    editor.write_button.click()
    assert session.blueprint.levels == {"ROBOT/1": "shared"}
    assert editor._levels.set == {}
    assert session.history.undoText() == "Take 1 level out"
    session.history.undo()
    assert session.blueprint.levels == {"supervision": "human", "ROBOT/1": "shared"}


def test_rows_are_found_by_words(qtbot: QtBot, session: Session) -> None:
    editor = _editor(qtbot, session)
    editor.search.setText("fact robot")
    assert [row.key for row in editor.model.rows] == ["ROBOT/0", "ROBOT/1"]
    editor.table.selectAll()
    editor.buttons["shared"].click()
    editor.search.setText("")
    assert editor.model.chosen == {"ROBOT/0": "shared", "ROBOT/1": "shared"}


def test_a_level_of_what_an_edit_takes_away_is_dropped(session: Session) -> None:
    levels = NextLevels(session)
    levels.put({"ROBOT/1": "human", "TOOLPLAN/0": "human"})
    session.edit("Delete", lambda bp: delete(bp, [Address("ROBOT")]))
    assert levels.set == {"TOOLPLAN/0": "human"}


def test_ctrl_z_takes_a_choice_back_and_ctrl_shift_z_makes_it_again(
    qtbot: QtBot, session: Session
) -> None:
    levels = NextLevels(session)
    levels.put({"TOOLPLAN/1": "human"})
    editor = LevelEditor(session, levels)
    qtbot.addWidget(editor)
    editor.show()
    editor.activateWindow()
    qtbot.waitUntil(editor.isActiveWindow)
    held = Qt.KeyboardModifier.ControlModifier
    again = held | Qt.KeyboardModifier.ShiftModifier
    for keys, level in ((("TOOLPLAN/0", "TOOLPLAN/1"), "shared"), (("TOOLPLAN/0",), "human")):
        _mark(editor, *keys)
        QTest.mouseClick(editor.buttons[level], Qt.MouseButton.LeftButton)
    seen = []
    for modifiers in (held, held, held, again, again, again):
        QTest.keyClick(editor.table, Qt.Key.Key_Z, modifiers)
        seen.append(dict(editor.model.chosen))
    first, second, last = (
        {"TOOLPLAN/1": "human"},
        {"TOOLPLAN/0": "shared", "TOOLPLAN/1": "shared"},
        {"TOOLPLAN/0": "human", "TOOLPLAN/1": "shared"},
    )
    assert seen == [second, first, first, second, last, last]
    QTest.keyClick(editor.table, Qt.Key.Key_Z, held)
    QTest.mouseClick(editor.buttons["human"], Qt.MouseButton.LeftButton)
    assert editor.model.chosen == {"TOOLPLAN/0": "human", "TOOLPLAN/1": "shared"}
    QTest.keyClick(editor.table, Qt.Key.Key_Z, again)
    assert editor.model.chosen == {"TOOLPLAN/0": "human", "TOOLPLAN/1": "shared"}
    QTest.keyClick(editor.table, Qt.Key.Key_Z, held)
    QTest.keyClick(editor.table, Qt.Key.Key_Z, held)
    assert not editor.use_button.isEnabled(), "it is as it was before"
