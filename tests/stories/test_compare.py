"""Comparing with a file, the saved text and a commit; going through the changes."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from PySide6.QtCore import QEvent, QPoint, QSize, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.qtbot import QtBot

from smsl_studio.blueprint import editing as edit
from smsl_studio.blueprint.address import Address
from smsl_studio.front.revisions import MOST, Revision
from smsl_studio.picture.labels import meet
from smsl_studio.studio.base.theme import LIGHT
from smsl_studio.studio.document.files import dialogs
from smsl_studio.studio.features.draw.compare.dialog import CompareDialog
from smsl_studio.studio.features.draw.compare.revision_dialog import RevisionDialog
from tests.git_folder import git_folder
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person


def asked(person: Person, action: str) -> CompareDialog:
    """Choose an action of the menu; the compare view it opened."""
    person.window.actions_table[action].trigger()
    dialog = person.window.comparing.dialog
    assert dialog is not None
    person.qtbot.waitExposed(dialog)
    dialog.activateWindow()
    person.qtbot.waitUntil(dialog.isActiveWindow)
    return dialog


def at(tmp_path: Path, name: str) -> Path:
    path = tmp_path / name
    path.write_bytes((SAMPLES / name).read_bytes())
    return path


def press(dialog: CompareDialog, key: Qt.Key, shift: bool = False) -> None:
    held = Qt.KeyboardModifier.ShiftModifier if shift else Qt.KeyboardModifier.NoModifier
    QTest.keyClick(dialog, key, held)
    QApplication.processEvents()


def test_the_dialog_says_what_the_file_is_asked_for(
    sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked_for: list[str] = []

    def ask(window: QWidget, title: str, folder: str, kinds: str) -> str:
        asked_for.append(title)
        return ""

    monkeypatch.setattr(dialogs, "ask_to_open", ask)
    person = sit(at(tmp_path, "hanoi-corrected.json"))
    person.window.actions_table["compare_file"].trigger()
    person.ctrl(Qt.Key.Key_O)
    assert asked_for == ["Compare with a blueprint", "Open blueprint"]


def test_the_corrected_file_against_the_printed_one(sit: Sit, tmp_path: Path) -> None:
    person = sit(at(tmp_path, "hanoi-corrected.json"))
    person.window.comparing.ask_file = lambda folder: SAMPLES / "hanoi.json"
    dialog = asked(person, "compare_file")
    rows = [row.text for row in dialog.changes.rows.rows]
    assert [text.split()[2] for text in rows] == ["Op_1c", "Op_2b"]
    before, after = dialog.before.canvas, dialog.after.canvas
    assert set(before.marks.changes) == {
        Address("SB1", "State_cbb", "Op_1c"), Address("SB1", "State_cbc", "Op_2b"),
    }  # fmt: skip
    assert set(after.marks.changes.values()) == {"~"}
    assert before.marks.selection == (Address("SB1", "State_cbb", "Op_1c"),)
    assert after.marks.selection == (Address("SB1", "State_cbb", "Op_1b"),)
    press(dialog, Qt.Key.Key_F7)
    assert after.marks.selection == (Address("SB1", "State_cbc", "Op_2a"),)
    press(dialog, Qt.Key.Key_F7)
    assert after.marks.selection == (Address("SB1", "State_cbb", "Op_1b"),)
    press(dialog, Qt.Key.Key_F7, shift=True)
    assert after.marks.selection == (Address("SB1", "State_cbc", "Op_2a"),)
    person.click(dialog.jump)
    assert person.window.session.selection == (Address("SB1", "State_cbc", "Op_2a"),)
    dialog.activateWindow()
    press(dialog, Qt.Key.Key_Escape)
    assert person.window.comparing.dialog is None


def test_the_drawing_comes_in_front_of_the_compare_view_and_f7_leads_back(
    sit: Sit, tmp_path: Path
) -> None:
    person = sit(at(tmp_path, "hanoi-corrected.json"))
    window = person.window
    window.comparing.ask_file = lambda folder: SAMPLES / "hanoi.json"
    dialog = asked(person, "compare_file")
    # Desktops keep a window that belongs to another one in front of it.
    handle = dialog.windowHandle()
    assert handle is not None
    assert handle.transientParent() is None
    assert dialog.windowType() is Qt.WindowType.Window
    assert dialog.screen().availableGeometry().contains(dialog.geometry())
    window.outline.tree.setFocus()
    person.press(Qt.Key.Key_Return)
    person.until(window.isActiveWindow)
    assert window.canvas.hasFocus()
    assert person.selected() == ["SB1/State_cbb/Op_1b"]
    assert "F7" in window.toast.words
    person.press(Qt.Key.Key_F7)
    person.until(dialog.isActiveWindow)
    assert dialog.after.canvas.marks.selection == (Address("SB1", "State_cbc", "Op_2a"),)
    assert dialog.changes.hasFocus()
    person.press(Qt.Key.Key_Return)
    person.until(window.isActiveWindow)
    assert person.selected() == ["SB1/State_cbc/Op_2a"]


def test_the_compare_view_opens_with_all_of_both_sides(sit: Sit, tmp_path: Path) -> None:
    person = sit(at(tmp_path, "hfsm.json"))
    places = {"State111": (2400.0, 40.0)}
    person.window.session.edit("Move", lambda b: edit.set_layout(b, "SB1", places))
    dialog = asked(person, "compare_saved")
    for side in (dialog.before, dialog.after):
        assert side.canvas.outside == 0


def test_the_compare_view_goes_with_its_window(sit: Sit, tmp_path: Path) -> None:
    person = sit(at(tmp_path, "hfsm.json"))
    dialog = asked(person, "compare_saved")
    person.window.close()
    assert not dialog.isVisible()


def test_both_sides_look_at_the_same_place(sit: Sit, tmp_path: Path) -> None:
    person = sit(at(tmp_path, "hanoi-corrected.json"))
    person.window.comparing.ask_file = lambda folder: SAMPLES / "hanoi.json"
    dialog = asked(person, "compare_file")
    before, after = dialog.before.canvas, dialog.after.canvas
    before.zoom_to(1.4)
    assert after.zoom == before.zoom
    after.camera.pan(120.0, 60.0)
    apart = before.camera.centre - after.camera.centre
    assert abs(apart.x()) < 2.0
    assert abs(apart.y()) < 2.0
    press(dialog, Qt.Key.Key_F)
    assert before.zoom == after.zoom < 1.4
    person.windows.set_theme("dark")
    assert before.tokens.dark
    assert after.tokens.dark
    person.windows.set_theme("light")


def test_the_view_follows_edits_against_what_was_saved(sit: Sit, tmp_path: Path) -> None:
    person = sit(at(tmp_path, "hfsm.json"))
    session = person.window.session
    dialog = asked(person, "compare_saved")
    assert dialog.windowTitle() == "Compare hfsm.json, as saved with hfsm.json, as it is drawn"
    assert dialog.changes.rows.rows == ()
    assert not dialog.next.isEnabled()
    session.edit("Move", lambda b: edit.set_layout(b, "SB1", {"State000": (5.0, 5.0)}))
    person.until(lambda: dialog.summary == "Layout only: 1 state was moved.")
    session.edit("Add", lambda b: edit.add_state(b, "SB2", "State2"))
    person.until(lambda: "1 added" in dialog.summary)
    assert dialog.after.canvas.sheet is not None
    person.choose(dialog.branches, "SB2")
    assert Address("SB2", "State2") in dialog.after.canvas.marks.changes
    assert dialog.after.canvas.rect_of(Address("SB2", "State2")) is not None
    while session.history.canUndo():
        session.history.undo()
    person.until(lambda: dialog.summary == "No difference.")
    noted = session.blueprint.document.text.replace("{", '{"_comment": "seen",', 1)
    session.write("Type", noted)
    person.until(lambda: "_comment differs" in dialog.summary)
    words = [dialog.changes.rows.rows[number].text for number in (0, 1)]
    assert words[0] == "Fields without meaning, which are no change"
    assert words[1].startswith("The field _comment of the file is ")
    assert dialog.next.isEnabled()


def test_of_a_broken_text_the_last_readable_version_is_compared(sit: Sit, tmp_path: Path) -> None:
    person = sit(at(tmp_path, "hfsm.json"))
    session = person.window.session
    text = session.blueprint.document.text
    session.write("Type", text.replace('"State000"', '"State', 1))
    assert session.broken is not None
    dialog = asked(person, "compare_saved")
    assert "as it last could be read" in dialog.windowTitle()
    assert dialog.summary == "No difference."


def test_a_commit_is_chosen_and_compared(
    sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, qtbot: QtBot
) -> None:
    git = git_folder(tmp_path, monkeypatch)
    path = tmp_path / "plan.json"
    path.write_text(json.dumps({"S": {"A": {"go": "B"}, "B": {}}}))
    person = sit(path)
    person.window.actions_table["compare_revision"].trigger()
    person.until(lambda: "in no git repository" in person.window.toast.words)
    git("init", "-q")
    git("add", "plan.json")
    git("commit", "-q", "-m", "Draw the plan")
    path.write_text(json.dumps({"S": {"A": {"walk": "B"}, "B": {}}}))
    git("commit", "-q", "-a", "-m", "Walk instead")
    person.window.actions_table["compare_revision"].trigger()
    person.until(lambda: person.window.findChild(RevisionDialog) is not None)
    asking = person.window.findChild(RevisionDialog)
    assert asking is not None
    assert asking.said.text() == "2 commits touched plan.json"
    QTest.keyClicks(asking.search, "draw")
    assert [row.text for row in asking.rows.rows.rows] == ["Draw the plan"]
    QTest.keyClick(asking.search, Qt.Key.Key_Return)
    person.until(lambda: person.window.comparing.is_open)
    dialog = person.window.comparing.dialog
    assert dialog is not None
    # The window still shows the plan as it was opened.
    assert dialog.summary == "No difference."
    assert " at " in dialog.windowTitle()
    dialog.close()
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)


def test_without_a_file_there_is_nothing_saved_to_compare_with(sit: Sit) -> None:
    actions = sit().window.actions_table
    assert not actions["compare_saved"].isEnabled()
    assert not actions["compare_revision"].isEnabled()
    assert not actions["next_change"].isEnabled()
    assert actions["compare_file"].isEnabled()


def test_the_choice_of_a_state_branch_is_as_wide_as_its_names(sit: Sit, tmp_path: Path) -> None:
    now, before = at(tmp_path, "three-levels.json"), tmp_path / "before.json"
    longer = "REGISTRATION_OF_THE_PATIENT"
    before.write_text(now.read_text("utf-8").replace("REGISTRATION", longer), "utf-8")
    person = sit(now)
    person.window.comparing.ask_file = lambda folder: before
    choice = asked(person, "compare_file").branches
    assert choice.currentText() == f"{longer} → REGISTRATION"
    assert choice.toolTip() == choice.currentText()
    # Beside the words stand the margin and the arrow.
    assert choice.width() > choice.fontMetrics().horizontalAdvance(choice.currentText()) + 30


def test_of_a_long_history_only_the_latest_commits_are_listed_and_it_says_so(
    qapp: QApplication, qtbot: QtBot
) -> None:
    one = Revision("0" * 40, "2026-01-01", "Ada", "Draw", "plan.json")
    for number, said in ((1, "1 commit touched plan.json"), (MOST, "The latest 500 commits")):
        parent = QWidget()
        qtbot.addWidget(parent)
        asking = RevisionDialog("plan.json", [one] * number, LIGHT, parent)
        assert asking.said.text().startswith(said)


def test_a_step_is_undone_and_done_again_in_the_compare_view(sit: Sit, tmp_path: Path) -> None:
    person = sit(at(tmp_path, "hfsm.json"))
    person.window.session.edit("Add", lambda bp: edit.add_state(bp, "SB1", "State011"))
    drawn = person.blueprint
    dialog = asked(person, "compare_saved")
    assert [row.text for row in dialog.changes.rows.rows] != []
    person.ctrl(Qt.Key.Key_Z)
    assert "State011" not in person.blueprint["SB1"].table
    person.until(lambda: [row.text for row in dialog.changes.rows.rows] == [])
    person.ctrl(Qt.Key.Key_Y)
    assert person.blueprint == drawn
    person.until(lambda: [row.text for row in dialog.changes.rows.rows] != [])


def test_a_drawing_that_is_not_shown_is_not_undone(sit: Sit, tmp_path: Path) -> None:
    person = sit(at(tmp_path, "hfsm.json"))
    person.window.session.edit("Add", lambda bp: edit.add_state(bp, "SB1", "State011"))
    for mode in (Qt.Key.Key_2, Qt.Key.Key_3):
        person.ctrl(mode)
        person.ctrl(Qt.Key.Key_Z)
        assert "State011" in person.blueprint["SB1"].table
        assert "Ctrl+1 shows it" in person.window.toast.words
    person.ctrl(Qt.Key.Key_1)
    person.ctrl(Qt.Key.Key_Z)
    assert "State011" not in person.blueprint["SB1"].table


def test_moving_one_state_is_reported_as_one_moved_state(sit: Sit, tmp_path: Path) -> None:
    """The first place by hand writes all places; the others stand where they stood."""
    path = tmp_path / "registration.json"
    path.write_bytes((SAMPLES / "registration.json").read_bytes())
    person = sit(path)
    first = next(iter(person.blueprint["REGISTRATION"].table))
    place = person.place(f"REGISTRATION/{first}")
    person.drag(place, place + QPoint(40, 120))
    assert len(person.blueprint["REGISTRATION"].notes.layout) > 1
    assert asked(person, "compare_saved").summary == "Layout only: 1 state was moved."


def test_no_name_of_a_comparison_lies_on_another_one(
    sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("smsl_studio.studio.base.screens.room", lambda _: QSize(1400, 900))
    person = sit(at(tmp_path, "hanoi.json"))
    person.window.session.edit(
        "Rename", lambda b: edit.rename(b, Address("SB1", "State_cbb", "Op_1c"), "Op_1b")
    )
    dialog = asked(person, "compare_saved")
    for side in (dialog.before, dialog.after):
        canvas = side.canvas
        assert canvas.sheet is not None
        everything = range(len(canvas.sheet.picture.operations))
        rest = [edge for edge in everything if not canvas.sheet.looks.is_lit(edge)]
        names = canvas.ground.edges.names(canvas.sheet, rest)
        lit = canvas.lit_layer.shown()
        assert len(lit) == 1
        counted = {e for mark in canvas.sheet.labels.hidden.of(rest) for e in mark.edges}
        places = {edge: canvas.sheet.geometry.label(edge) for edge in rest}
        below = {
            edge
            for edge, place in places.items()
            for one in lit.values()
            if place is not None and meet(place, one.rect)
        }
        assert names.keys() | counted | below == set(rest), "a name is neither shown nor counted"
        assert 2 * len(names) > len(rest), "most names have room"
        assert not [n for n in names.values() for one in lit.values() if meet(n, one.rect)]


def test_each_side_says_which_version_it_is_and_where(sit: Sit, tmp_path: Path) -> None:
    person = sit(at(tmp_path, "hanoi-corrected.json"))
    person.window.comparing.ask_file = lambda folder: SAMPLES / "hanoi.json"
    dialog = asked(person, "compare_file")
    for side, words in (
        (dialog.before, "Before, at the left: "),
        (dialog.after, "After, at the right: "),
    ):
        assert side.title.text().startswith(words)
        assert side.title.toolTip().startswith(words), "a cut name can be read whole"
        assert side.canvas.camera.fitted


def test_a_note_alone_is_told_as_one_difference_in_words(sit: Sit, tmp_path: Path) -> None:
    person = sit(at(tmp_path, "hfsm.json"))
    person.select("SB1/State100")
    person.window.actions_table["add_note"].trigger()
    person.type("Ask the clinic")
    person.ctrl(Qt.Key.Key_Return)
    person.press(Qt.Key.Key_Escape)
    dialog = asked(person, "compare_saved")
    assert dialog.summary == "Same meaning: only 1 note differs."
    rows = [row.text for row in dialog.changes.rows.rows if row.kind != "section"]
    assert rows == ["The note “Ask the clinic” is added to SB1."]
