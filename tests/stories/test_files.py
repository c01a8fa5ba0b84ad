"""Files in the window: new, open, save, save as, recent, dropped, broken, unsaved."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest
from PySide6.QtCore import QMimeData, QPoint, QPointF, Qt, QTimer, QUrl
from PySide6.QtGui import QDragEnterEvent, QDropEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QApplication,
    QFileDialog,
    QFileSystemModel,
    QLineEdit,
    QMenu,
    QMessageBox,
)

from smsl_studio.blueprint import editing
from smsl_studio.smsl.files import read_document
from smsl_studio.studio.document.files import dialogs
from smsl_studio.studio.document.files.dialogs import Dialogs
from smsl_studio.studio.shell.window import Window
from tests.stories.at_outline import texts
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person, sample

Key = Qt.Key


def copy_of(name: str, folder: Path) -> Path:
    return Path(shutil.copy(SAMPLES / name, folder / name))


def edit(person: Person) -> None:
    """Any edit: another state."""
    person.window.session.edit(
        "Add Z", lambda bp: editing.add_state(bp, next(iter(bp.branches)), "State_zzz")
    )


def answer(person: Person, words: str) -> None:
    """Press a button of the question that comes up next."""

    def press() -> None:
        box = QApplication.activeModalWidget()
        assert isinstance(box, QMessageBox)
        button = next(b for b in box.buttons() if b.text().replace("&", "") == words)
        button.click()

    QTimer.singleShot(50, person.window, press)


def test_a_window_without_a_file_is_an_empty_blueprint(sit: Sit) -> None:
    person = sit()
    assert list(person.blueprint.branches) == ["SB1"]
    assert person.window.menu_row.title == "untitled.json"
    assert person.window.canvas.overlays.empty.isVisible()


def test_the_first_samples_are_offered_where_nothing_is_drawn(sit: Sit) -> None:
    person = sit()
    menus = set(person.window.findChildren(QMenu))
    person.click(person.window.canvas.overlays.empty.sample)
    menu = next(m for m in person.window.findChildren(QMenu) if m not in menus)
    action = next(a for a in menu.actions() if a.text() == "hfsm.json")
    action.trigger()
    menu.close()
    assert person.blueprint == sample("hfsm.json")
    assert person.window.files.path is None, "a sample is opened as a copy"


def test_a_sample_that_is_opened_in_an_empty_sub_sb_leaves_the_drawing_alone(
    sit: Sit, tmp_path: Path
) -> None:
    path = copy_of("hfsm.json", tmp_path)
    person = sit(path)
    person.window.session.edit("Add SB9", lambda bp: editing.add_branch(bp, "SB9"))
    assert person.window.files.save()
    person.window.session.show_branch("SB9")
    drawn = person.blueprint
    person.click(person.window.canvas.overlays.empty.sample)
    person.choose_in_menu("hanoi.json")
    person.until(lambda: len(list(person.windows)) == 2)
    assert person.blueprint is drawn
    assert person.window.files.path == path
    other = next(one for one in person.windows if one is not person.window)
    assert isinstance(other, Window)
    assert other.session.blueprint == sample("hanoi.json")
    assert (other.files.path, other.mode) == (None, "draw")


def test_open_edit_save_changes_only_what_was_edited(sit: Sit, tmp_path: Path) -> None:
    path = copy_of("registration.json", tmp_path)
    before = path.read_bytes()
    person = sit(path)
    assert person.window.menu_row.title == "registration.json"
    edit(person)
    assert person.window.menu_row.title == "registration.json edited"
    person.ctrl(Key.Key_S)
    assert person.window.menu_row.title == "registration.json"
    after = path.read_bytes()
    assert after != before
    # The last state was ACTIVATING because nothing said so; the header says it from now on.
    header = b'        "HEADER": {},'
    assert before.splitlines().count(header) - after.splitlines().count(header) == 1
    assert b'"ACTIVATING"' in after.splitlines()[before.splitlines().index(header) + 1]
    assert set(before.splitlines()) <= set(after.splitlines()) | {b"        }", header}
    person.ctrl(Key.Key_Z)
    assert person.window.menu_row.title == "registration.json edited"
    person.ctrl(Key.Key_S)
    assert path.read_bytes() == before


def is_ready(dialog: QFileDialog, folder: Path) -> bool:
    """Whether a file dialog has the keyboard and has read a folder that is not empty."""
    model = dialog.findChild(QFileSystemModel)
    listed = model is not None and model.rowCount(model.index(str(folder))) > 0
    return listed and dialog.isActiveWindow()


def test_save_as_asks_in_a_dialog_and_goes_on_there(sit: Sit, tmp_path: Path) -> None:
    person = sit(copy_of("hfsm.json", tmp_path))
    target = tmp_path / "other"

    def type_name() -> None:
        dialog = QApplication.activeModalWidget()
        if not isinstance(dialog, QFileDialog) or not is_ready(dialog, tmp_path):
            # Until then the dialog takes the file that it chose itself, not a typed name.
            QTimer.singleShot(20, person.window, type_name)
            return
        field = dialog.findChild(QLineEdit, "fileNameEdit")
        assert field is not None
        field.setText(str(target))
        field.setFocus()
        QTest.keyClick(field, Key.Key_Return)

    QTimer.singleShot(20, person.window, type_name)
    person.press(
        Key.Key_S, [Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier]
    )
    assert person.window.files.path == target.with_suffix(".json")
    assert read_document(target.with_suffix(".json")).text == (SAMPLES / "hfsm.json").read_text()
    assert person.window.menu_row.title == "other.json"
    assert person.window.canvas.overlays.breadcrumb.words[0] == "other.json"


def test_a_file_that_is_no_text_is_refused_and_nothing_is_lost(
    sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    picture = tmp_path / "picture.json"
    picture.write_bytes(b"{\n\xff")
    person = sit(copy_of("hfsm.json", tmp_path))
    monkeypatch.setattr(Dialogs, "file_to_open", lambda *_: picture)
    person.ctrl(Key.Key_O)
    said = person.window.toast.words
    assert "picture.json:2:1" in said
    assert person.blueprint == sample("hfsm.json")
    assert person.window.menu_row.title == "hfsm.json"


def test_a_save_that_fails_is_said_and_nothing_is_lost(sit: Sit, tmp_path: Path) -> None:
    path = copy_of("hfsm.json", tmp_path)
    person = sit(path)
    edit(person)
    path.unlink()
    path.mkdir()
    person.ctrl(Key.Key_S)
    assert person.window.toast.words
    assert person.window.session.edited
    assert "State_zzz" in person.blueprint["SB1"].table


@pytest.mark.parametrize(("words", "gone"), [("Cancel", False), ("Discard changes", True)])
def test_unsaved_work_is_asked_about(sit: Sit, tmp_path: Path, words: str, gone: bool) -> None:
    person = sit(copy_of("hfsm.json", tmp_path))
    edit(person)
    answer(person, words)
    person.ctrl(Key.Key_N)
    assert ("State_zzz" not in person.blueprint["SB1"].table) is gone


def test_closing_saves_where_that_is_the_answer(sit: Sit, tmp_path: Path) -> None:
    path = copy_of("hfsm.json", tmp_path)
    person = sit(path)
    edit(person)
    answer(person, "Cancel")
    assert not person.window.close()
    answer(person, "Save")
    assert person.window.close()
    assert "State_zzz" in path.read_text()


def test_recent_files_are_offered_newest_first(sit: Sit, tmp_path: Path) -> None:
    first, second = copy_of("hfsm.json", tmp_path), copy_of("hanoi.json", tmp_path)
    person = sit(first)
    person.window.files.open(second)
    menu = _menu(person.window, "Open recent")
    menu.aboutToShow.emit()
    assert [a.text() for a in menu.actions()] == ["hanoi.json", "hfsm.json"]
    menu.actions()[1].trigger()
    assert person.blueprint == sample("hfsm.json")


def test_a_file_dropped_on_the_window_is_opened(sit: Sit, tmp_path: Path) -> None:
    person = sit()
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(os.fspath(copy_of("hanoi.json", tmp_path)))])
    copy, none = Qt.DropAction.CopyAction, Qt.KeyboardModifier.NoModifier
    enter = QDragEnterEvent(QPoint(600, 400), copy, data, Qt.MouseButton.LeftButton, none)
    QApplication.sendEvent(person.window, enter)
    assert enter.isAccepted()
    drop = QDropEvent(QPointF(600, 400), copy, data, Qt.MouseButton.LeftButton, none)
    QApplication.sendEvent(person.window, drop)
    person.until(lambda: person.window.files.name == "hanoi.json")


def test_several_files_dropped_on_the_window_have_a_window_each(sit: Sit, tmp_path: Path) -> None:
    person = sit()
    names = ("hanoi.json", "hfsm.json")
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(os.fspath(copy_of(name, tmp_path))) for name in names])
    copy, none = Qt.DropAction.CopyAction, Qt.KeyboardModifier.NoModifier
    at = QPointF(600, 400)
    enter = QDragEnterEvent(at.toPoint(), copy, data, Qt.MouseButton.LeftButton, none)
    QApplication.sendEvent(person.window, enter)
    drop = QDropEvent(at, copy, data, Qt.MouseButton.LeftButton, none)
    QApplication.sendEvent(person.window, drop)
    person.until(lambda: [window.name for window in person.windows] == list(names))


def test_recent_files_are_told_apart_and_shown_as_they_are_called(sit: Sit, tmp_path: Path) -> None:
    (tmp_path / "deeper").mkdir()
    here, there = copy_of("hfsm.json", tmp_path), copy_of("hfsm.json", tmp_path / "deeper")
    odd = tmp_path / "this & that.json"
    odd.write_text("{}")
    person = sit(odd)
    for path in (here, there):
        person.window.files.open(path)
    menu = _menu(person.window, "Open recent")
    menu.aboutToShow.emit()
    shown = [action.text() for action in menu.actions()]
    assert shown[2] == "this && that.json"
    assert len({*shown[:2]}) == 2
    assert all(text.startswith("hfsm.json in ") for text in shown[:2])


def test_a_new_window_has_the_theme_and_panels_of_the_last_one(sit: Sit, tmp_path: Path) -> None:
    person = sit(copy_of("hfsm.json", tmp_path), (1300, 820))
    person.windows.set_theme("dark")
    person.ctrl(Key.Key_J)
    assert not person.window.docks.bottom.isVisible()
    assert person.window.close()
    again = Window(person.windows)
    again.show()
    again.resize(1300, 820)
    assert again.tokens.dark
    assert not again.docks.bottom.isVisible()
    assert again.docks.left.isVisible()
    again.close()


def _menu(window: Window, title: str) -> QMenu:
    return next(menu for menu in window.findChildren(QMenu) if menu.title() == title)


def test_opening_the_file_that_is_saved_on_the_way_shows_what_was_saved(
    sit: Sit, tmp_path: Path
) -> None:
    path = copy_of("hfsm.json", tmp_path)
    person = sit(path)
    edit(person)
    answer(person, "Save")
    assert person.window.files.open(path)
    assert "State_zzz" in path.read_text()
    assert "State_zzz" in person.blueprint["SB1"].table, "the next save would lose it"


def test_what_is_still_being_typed_is_saved_along(sit: Sit, tmp_path: Path) -> None:
    path = copy_of("hfsm.json", tmp_path)
    person = sit(path)
    person.select("SB1/State100")
    person.click(person.window.properties.state.title)
    person.type("Ready")
    person.ctrl(Key.Key_S)
    assert '"Ready"' in path.read_text()
    person.type(" now")
    assert person.window.properties.state.title.text() == "Ready now"
    answer(person, "Cancel")
    assert not person.window.close(), "what was typed is unsaved work"


def test_a_state_branch_that_is_still_being_named_is_saved_along(sit: Sit, tmp_path: Path) -> None:
    path = copy_of("hfsm.json", tmp_path)
    person = sit(path)
    person.window.outline.tree.setFocus()
    person.press(Key.Key_F2)
    person.type("Digits")
    person.ctrl(Key.Key_S)
    assert '"Digits"' in path.read_text()
    assert not person.window.session.edited
    tree = person.window.outline.tree
    person.until(lambda: "Digits" in texts(tree))


def test_a_name_without_an_ending_does_not_replace_a_file_unasked(
    sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    person = sit(copy_of("hfsm.json", tmp_path))
    other = copy_of("hanoi.json", tmp_path)
    before = other.read_bytes()
    typed = str(tmp_path / "hanoi"), ""
    monkeypatch.setattr(dialogs, "ask_to_save", lambda *_: typed)
    answer(person, "Cancel")
    assert not person.window.files.save_as()
    assert other.read_bytes() == before
    answer(person, "Replace hanoi.json")
    assert person.window.files.save_as()
    assert other.read_bytes() != before


def test_undo_past_a_save_as_keeps_the_new_name(
    sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    person = sit(copy_of("hfsm.json", tmp_path))
    edit(person)
    target = tmp_path / "other.json"
    monkeypatch.setattr(Dialogs, "file_to_save", lambda *_: target)
    assert person.window.files.save_as()
    person.ctrl(Key.Key_Z)
    assert person.blueprint.file == str(target)
    assert person.window.session.edited
    person.ctrl(Key.Key_Y)
    assert person.blueprint.file == str(target)
    assert not person.window.session.edited


def test_findings_of_the_last_file_are_not_shown_for_the_next(sit: Sit, tmp_path: Path) -> None:
    person = sit(copy_of("hanoi.json", tmp_path))
    person.until_inspected()
    assert person.window.findings.findings
    person.window.files.open(copy_of("hfsm.json", tmp_path))
    assert not person.window.inspector.current
    assert not person.window.findings.findings
    assert "Not checked yet" in person.window.findings.empty.text()
    assert not person.window.canvas.marks.findings


def test_quit_closes_every_window_and_each_asks(sit: Sit, tmp_path: Path) -> None:
    first, second = sit(copy_of("hfsm.json", tmp_path)), sit(copy_of("hanoi.json", tmp_path))
    edit(first)
    answer(first, "Cancel")
    second.ctrl(Key.Key_Q)
    assert first.window.isVisible()
    answer(first, "Discard changes")
    first.windows.quit()
    assert list(first.windows) == []


def test_the_theme_is_that_of_every_window(sit: Sit) -> None:
    first, second = sit(), sit()
    second.windows.set_theme("dark")
    assert first.window.tokens.dark
    assert first.window.canvas.tokens.dark


def test_menus_that_are_used_once_are_deleted(sit: Sit, tmp_path: Path) -> None:
    person = sit(copy_of("hfsm.json", tmp_path))
    before = len(person.window.findChildren(QMenu))
    person.window.canvas.context_wanted.emit(None, QPoint(300, 300))
    popup = QApplication.activePopupWidget()
    assert isinstance(popup, QMenu)
    popup.close()
    person.until(lambda: len(person.window.findChildren(QMenu)) == before)


def test_a_new_window_is_placed_beside_and_independent(sit: Sit, tmp_path: Path) -> None:
    person = sit(copy_of("hfsm.json", tmp_path))
    before = set(person.windows)
    person.window.actions_table["new_window"].trigger()
    (other,) = set(person.windows) - before
    assert isinstance(other, Window)
    assert other.isVisible()
    assert other.name == "untitled.json"
    edit(person)
    assert not other.session.edited


def test_undo_and_redo_past_two_other_forms_come_back_to_the_saved_bytes(
    sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    given = tmp_path / "cell.json"
    given.write_text('{\n "A": {"HEADER": {}, "S_0": {"go": "S_1"}, "S_1": {}},\n'
                     ' "B": {"HEADER": {}, "T_0": {"go": "T_1"}, "T_1": {}}\n}\n')  # fmt: skip
    person = sit(given)
    person.select("A/S_0")
    edit(person)
    for name in ("cell.smsl", "cell.yaml"):
        monkeypatch.setattr(Dialogs, "file_to_save", lambda *_, name=name: tmp_path / name)
        assert person.window.files.save_as()
    target = tmp_path / "cell.yaml"
    saved = target.read_text()
    session = person.window.session
    for _ in range(2):
        while session.history.canUndo():
            session.history.undo()
        while session.history.canRedo():
            session.history.redo()
        assert not session.edited
        assert session.blueprint.document.text == saved
