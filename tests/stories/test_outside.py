"""Other programs change open files: the window notices, tells, and overwrites nothing unasked."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from PySide6.QtCore import QEvent, Qt, QTimer
from PySide6.QtWidgets import QApplication, QMessageBox

from smsl_studio.blueprint import editing
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person


def copy_of(name: str, folder: Path) -> Path:
    return Path(shutil.copy(SAMPLES / name, folder / name))


def replaced(path: Path, text: str) -> None:
    """Another program saves as careful ones do: a new file takes the place of the old one."""
    fresh = path.with_name("fresh.tmp")
    fresh.write_text(text)
    fresh.replace(path)


def written(path: Path, text: str) -> None:
    """Another program writes into the file itself."""
    path.write_text(text)


def other(path: Path) -> str:
    """The text of a file with a state renamed."""
    return path.read_text().replace("State111", "State999")


def edit(person: Person) -> None:
    person.window.session.edit("Add", lambda bp: editing.add_state(bp, "SB1", "State_mine"))


def bar(person: Person) -> str:
    shown = person.window.safety.bar
    return shown.said.text() if shown.isVisible() else ""


@pytest.mark.parametrize("write", [replaced, written])
def test_a_file_without_unsaved_changes_follows_the_disk(
    sit: Sit, tmp_path: Path, write: object
) -> None:
    path = copy_of("hfsm.json", tmp_path)
    person = sit(path)
    person.window.session.show_branch("SB2")
    person.select("SB2/State0")
    for name in ("State999", "State888"):
        assert callable(write)
        write(path, path.read_text().replace("State111", name).replace("State999", name))
        person.until(lambda name=name: name in person.blueprint["SB1"].table)  # type: ignore[misc]
    assert "was changed outside this window" in person.window.toast.words
    assert person.window.menu_row.title == "hfsm.json"
    assert person.window.session.branch == "SB2"
    assert person.selected() == ["SB2/State0"]
    person.window.session.history.undo()
    assert person.window.menu_row.title == "hfsm.json edited", "the older text is unsaved work"


def test_with_unsaved_changes_the_person_is_asked_and_takes_theirs(
    sit: Sit, tmp_path: Path
) -> None:
    path = copy_of("hfsm.json", tmp_path)
    person = sit(path)
    edit(person)
    theirs = other(path)
    replaced(path, theirs)
    person.until(lambda: bar(person) == "hfsm.json was changed outside this window.")
    assert "State_mine" in person.blueprint["SB1"].table
    person.click(person.window.safety.bar.theirs)
    assert person.window.session.texts[str(path)] == theirs
    assert person.window.menu_row.title == "hfsm.json"
    assert not bar(person)
    person.window.session.history.undo()
    assert "State_mine" in person.blueprint["SB1"].table, "nothing is lost by looking"


def test_the_own_text_is_kept_and_saved_over_theirs(sit: Sit, tmp_path: Path) -> None:
    path = copy_of("hfsm.json", tmp_path)
    person = sit(path)
    edit(person)
    replaced(path, other(path))
    person.until(lambda: bool(bar(person)))
    person.click(person.window.safety.bar.mine)
    assert not bar(person)
    person.window.session.history.undo()
    assert person.window.menu_row.title == "hfsm.json edited", "the disk holds another text"
    person.window.session.history.redo()
    assert person.window.files.save(), "it was decided, so it is not asked again"
    assert "State_mine" in path.read_text()


def test_the_difference_is_shown(sit: Sit, tmp_path: Path) -> None:
    path = copy_of("hfsm.json", tmp_path)
    person = sit(path)
    edit(person)
    replaced(path, other(path))
    person.until(lambda: bool(bar(person)))
    person.click(person.window.safety.bar.difference)
    dialog = person.window.comparing.dialog
    assert dialog is not None
    assert bar(person), "looking decides nothing"
    dialog.close()


def test_saving_over_an_unseen_change_asks_first(sit: Sit, tmp_path: Path) -> None:
    path = copy_of("hfsm.json", tmp_path)
    person = sit(path)
    edit(person)
    # The watcher is deaf, as it is on some network folders.
    person.window.safety.outside.watcher.stop()
    theirs = other(path)
    replaced(path, theirs)
    asked: list[str] = []

    def answer(words: str) -> None:
        box = QApplication.activeModalWidget()
        assert isinstance(box, QMessageBox)
        asked.append(box.text())
        next(b for b in box.buttons() if b.text() == words).click()

    QTimer.singleShot(50, person.window, lambda: answer("Cancel"))
    assert not person.window.files.save()
    assert path.read_text() == theirs
    QTimer.singleShot(50, person.window, lambda: answer("Save over it"))
    assert person.window.files.save()
    assert "State_mine" in path.read_text()
    assert asked[0] == "hfsm.json was changed outside this window since it was read."


def test_who_comes_back_to_the_window_sees_what_has_changed(sit: Sit, tmp_path: Path) -> None:
    path = copy_of("hfsm.json", tmp_path)
    person = sit(path)
    person.window.safety.outside.watcher.stop()
    replaced(path, other(path))
    QApplication.sendEvent(person.window, QEvent(QEvent.Type.WindowActivate))
    assert "State999" in person.blueprint["SB1"].table


def test_a_file_that_is_gone_is_told_and_written_again(sit: Sit, tmp_path: Path) -> None:
    path = copy_of("hfsm.json", tmp_path)
    person = sit(path)
    path.rename(tmp_path / "elsewhere.json")
    person.until(lambda: "is gone from its folder" in person.window.toast.words)
    assert person.window.menu_row.title == "hfsm.json edited"
    assert person.window.files.save()
    assert path.read_bytes() == (SAMPLES / "hfsm.json").read_bytes()


def test_an_own_save_is_not_taken_for_a_change_by_another_program(sit: Sit, tmp_path: Path) -> None:
    path = copy_of("hfsm.json", tmp_path)
    person = sit(path)
    edit(person)
    assert person.window.files.save()
    person.window.safety.outside.look()
    assert person.window.toast.words == "Saved hfsm.json."
    assert not bar(person)


def test_a_text_that_no_longer_reads_is_shown_when_it_stays_so(sit: Sit, tmp_path: Path) -> None:
    path = copy_of("hfsm.json", tmp_path)
    person = sit(path)
    half = path.read_text()[:200]
    written(path, half)
    person.until(lambda: person.window.session.broken is not None)
    assert person.window.session.texts[str(path)] == half
    assert person.window.docks.right_tabs.current == "Source"
    shutil.copy(SAMPLES / "hfsm.json", path)
    person.until(lambda: person.window.session.broken is None)
    assert person.window.menu_row.title == "hfsm.json"


def test_an_imported_file_is_watched_too(sit: Sit, tmp_path: Path) -> None:
    inner = tmp_path / "inner.json"
    inner.write_text('{"SB2": {"State_0": {"Op": "State_1"}, "State_1": {}}}')
    outer = tmp_path / "outer.json"
    outer.write_text('{"_imports": ["inner.json", "late.json"], "SB1": {"State_0": {}}}')
    person = sit(outer)
    replaced(inner, inner.read_text().replace("Op", "Other"))
    person.until(lambda: "Other" in person.blueprint["SB2"].table["State_0"])
    (tmp_path / "late.json").write_text('{"SB3": {"State_0": {}}}')
    person.until(lambda: "SB3" in person.blueprint.branches)
    assert person.window.menu_row.title == "outer.json"
    person.window.session.edit("Add", lambda bp: editing.add_state(bp, "SB2", "State_2"))
    assert person.window.menu_row.title == "outer.json inner.json edited"
    replaced(inner, "{}")
    person.until(lambda: bar(person).startswith("inner.json was changed"))


def test_what_a_save_cannot_keep_is_said_before_and_once(sit: Sit, tmp_path: Path) -> None:
    path = copy_of("hfsm.json", tmp_path)
    before = path.read_text()
    person = sit(path)
    asked: list[str] = []

    def answer(words: str) -> None:
        box = QApplication.activeModalWidget()
        assert isinstance(box, QMessageBox)
        asked.append(box.text())
        next(b for b in box.buttons() if b.text() == words).click()

    def linked() -> None:
        path.with_name("second.json").unlink(missing_ok=True)
        path.with_name("second.json").hardlink_to(path)

    linked()
    edit(person)
    QTimer.singleShot(50, person.window, lambda: answer("Cancel"))
    assert not person.window.files.save()
    assert path.read_text() == before
    QTimer.singleShot(50, person.window, lambda: answer("Save"))
    assert person.window.files.save()
    linked()
    person.window.session.edit("Add", lambda bp: editing.add_state(bp, "SB1", "State_more"))
    assert person.window.files.save(), "what was agreed to is not asked again"
    assert "State_more" in path.read_text()
    lost = "Saved, hfsm.json loses another name (hard links), which would keep the old text."
    assert asked == [lost, lost]


@pytest.mark.parametrize("answer", ["theirs", "mine"])
def test_after_the_answer_one_goes_on_where_one_typed(
    sit: Sit, tmp_path: Path, answer: str
) -> None:
    path = copy_of("hfsm.json", tmp_path)
    person = sit(path)
    edit(person)
    person.window.show_tab("Source")
    editor = person.window.source.editor
    person.click(editor.viewport())
    assert editor.hasFocus()
    replaced(path, other(path))
    person.until(lambda: bool(bar(person)))
    button = getattr(person.window.safety.bar, answer)
    button.setFocus(Qt.FocusReason.MouseFocusReason)
    person.click(button)
    assert not bar(person)
    assert editor.hasFocus()
