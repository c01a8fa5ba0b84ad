"""Work that could be lost unnoticed: each of these texts is kept somewhere, and the window says
so."""

from __future__ import annotations

from pathlib import Path

import pytest
from PySide6.QtCore import QEvent
from PySide6.QtWidgets import QAbstractButton, QApplication

from smsl_studio.blueprint import editing
from smsl_studio.studio.document.files.dialogs import Dialogs
from smsl_studio.studio.document.journal.leftovers import left_behind
from smsl_studio.studio.document.journal.place import JournalFile
from smsl_studio.studio.shell.application import offer_recovery
from tests.stories.conftest import Sit
from tests.stories.person import Person
from tests.stories.test_outside import bar, replaced
from tests.stories.test_recovery import die, offer_to, words_of
from tests.stories.test_several_files import INNER, answer

OUTER = '{\n  "_imports": ["inner.json"],\n  "SB1": {"State_0": {}}\n}\n'
ALONE = '{\n  "SB1": {"State_0": {}}\n}\n'


@pytest.fixture
def outer(tmp_path: Path) -> Path:
    """A file that imports another one, in which SB2 stands."""
    (tmp_path / "inner.json").write_text(INNER)
    path = tmp_path / "outer.json"
    path.write_text(OUTER)
    return path


def inner_of(outer: Path) -> Path:
    return outer.with_name("inner.json")


def add(person: Person, branch: str, name: str = "State_9") -> None:
    person.window.session.edit(f"Add {name}", lambda bp: editing.add_state(bp, branch, name))


def leave_out(person: Person, text: str = ALONE) -> None:
    """Type the import away."""
    person.window.session.write("Type", text)


def look(person: Person) -> None:
    QApplication.sendEvent(person.window, QEvent(QEvent.Type.WindowActivate))


def test_a_file_that_is_imported_no_longer_keeps_its_unsaved_text(sit: Sit, outer: Path) -> None:
    person = sit(outer)
    add(person, "SB2")
    leave_out(person)
    assert "SB2" not in person.blueprint.branches
    assert person.window.menu_row.title == "outer.json and 1 more edited"
    assert "inner.json" in person.window.toast.words
    told: list[str] = []
    answer(person, "Cancel", told)
    assert not person.window.close()
    assert told == ["outer.json and inner.json have unsaved changes."]
    assert person.window.files.save()
    assert "State_9" in inner_of(outer).read_text()
    assert outer.read_text() == ALONE
    assert person.window.menu_row.title == "outer.json"
    person.window.session.history.undo()
    person.window.session.history.undo()
    assert person.window.files.save()
    assert (outer.read_text(), inner_of(outer).read_text()) == (OUTER, INNER)


def test_an_undo_that_takes_out_an_import_keeps_what_is_unsaved_in_it(
    sit: Sit, outer: Path
) -> None:
    outer.write_text(ALONE)
    person = sit(outer)
    leave_out(person, OUTER)
    add(person, "SB2")
    assert person.window.files.save()
    person.window.session.history.undo()
    person.window.session.history.undo()
    assert person.window.menu_row.title == "outer.json and 1 more edited"
    assert person.window.files.save()
    assert (outer.read_text(), inner_of(outer).read_text()) == (ALONE, INNER)
    person.window.session.history.redo()
    person.window.session.history.redo()
    assert person.window.files.save()
    assert "State_9" in inner_of(outer).read_text()
    assert outer.read_text() == OUTER


def test_the_form_that_takes_out_an_import_keeps_what_is_unsaved_in_it(
    sit: Sit, outer: Path
) -> None:
    person = sit(outer)
    add(person, "SB2")
    person.window.session.show_branch("SB1")
    found = person.window.properties.file.findChildren(QAbstractButton)
    (button,) = (one for one in found if one.toolTip() == "Import this file no longer")
    person.click(button)
    assert "SB2" not in person.blueprint.branches
    assert person.window.menu_row.title == "outer.json and 1 more edited"
    assert person.window.files.save()
    assert "State_9" in inner_of(outer).read_text()


def test_a_file_that_is_imported_again_comes_with_its_unsaved_text(sit: Sit, outer: Path) -> None:
    person = sit(outer)
    add(person, "SB2")
    leave_out(person)
    person.window.session.write("Type", OUTER)
    assert "State_9" in person.blueprint["SB2"].table
    assert person.window.menu_row.title == "outer.json inner.json edited"
    person.window.session.history.undo()
    assert person.window.files.save()
    assert "State_9" in inner_of(outer).read_text()


def test_the_text_of_a_file_that_left_is_in_the_journal(sit: Sit, outer: Path) -> None:
    first = sit(outer)
    add(first, "SB2")
    leave_out(first)
    die(first)
    person = sit()
    (row,) = offer_to(person).rows.values()
    person.click(row.recover)
    assert person.window.session.texts[str(outer)] == ALONE
    (aside,) = (person.windows.settings.folder / "recovered").iterdir()
    assert "State_9" in aside.read_text()


def test_another_program_that_drops_the_import_takes_no_work_along(sit: Sit, outer: Path) -> None:
    person = sit(outer)
    add(person, "SB2")
    replaced(outer, ALONE)
    person.until(lambda: "SB2" not in person.blueprint.branches)
    assert person.window.menu_row.title == "outer.json inner.json edited"
    assert person.window.files.save()
    assert "State_9" in inner_of(outer).read_text()


def test_the_window_asks_about_a_file_that_is_no_longer_imported_and_was_changed(
    sit: Sit, outer: Path
) -> None:
    person = sit(outer)
    add(person, "SB2")
    leave_out(person)
    theirs = INNER.replace("Up", "Higher")
    replaced(inner_of(outer), theirs)
    person.until(lambda: bar(person).startswith("inner.json was changed"))
    person.click(person.window.safety.bar.theirs)
    assert not bar(person)
    assert person.window.menu_row.title == "outer.json edited"
    assert person.window.files.save()
    assert inner_of(outer).read_text() == theirs
    person.window.session.history.undo()
    person.window.session.history.undo()
    assert "State_9" in person.blueprint["SB2"].table
    assert person.window.menu_row.title == "outer.json and 1 more edited"


def test_a_file_that_was_changed_while_it_was_not_imported_is_looked_at(
    sit: Sit, outer: Path
) -> None:
    person = sit(outer)
    leave_out(person)
    replaced(inner_of(outer), INNER.replace("Up", "Higher"))
    person.window.session.history.undo()
    person.until(lambda: "Higher" in person.blueprint["SB2"].table["State_0"])
    assert person.window.menu_row.title == "outer.json"


def test_a_file_that_was_deleted_and_imported_no_longer_stays_deleted(
    sit: Sit, outer: Path
) -> None:
    person = sit(outer)
    inner_of(outer).unlink()
    person.until(lambda: "is gone" in person.window.toast.words)
    leave_out(person)
    assert person.window.files.save()
    assert not inner_of(outer).exists()


def test_a_file_that_changed_since_the_kill_is_asked_about(sit: Sit, outer: Path) -> None:
    first = sit(outer)
    add(first, "SB1")
    die(first)
    theirs = OUTER.replace("State_0", "State_7")
    replaced(outer, theirs)
    person = sit()
    offer = offer_to(person)
    assert "changed on the disk since" in words_of(offer)
    (row,) = offer.rows.values()
    person.click(row.recover)
    person.until(lambda: bar(person) == "outer.json was changed outside this window.")
    told: list[str] = []
    answer(person, "Cancel", told)
    assert not person.window.files.save()
    assert "changed outside this window" in told[0]
    assert outer.read_text() == theirs
    person.click(person.window.safety.bar.theirs)
    assert person.window.session.texts[str(outer)] == theirs
    assert person.window.menu_row.title == "outer.json"
    person.window.session.history.undo()
    assert "State_9" in person.blueprint["SB1"].table


def test_an_imported_file_that_changed_since_the_kill_is_asked_about(sit: Sit, outer: Path) -> None:
    first = sit(outer)
    add(first, "SB2")
    die(first)
    replaced(inner_of(outer), INNER.replace("Up", "Higher"))
    person = sit()
    (row,) = offer_to(person).rows.values()
    person.click(row.recover)
    person.until(lambda: bar(person) == "inner.json was changed outside this window.")


def test_a_text_that_cannot_be_shown_beside_a_broken_one_is_put_aside(
    sit: Sit, outer: Path
) -> None:
    first = sit(outer)
    add(first, "SB2")
    die(first)
    outer.write_text(OUTER.replace("{}", "{"))
    person = sit()
    (row,) = offer_to(person).rows.values()
    person.click(row.recover)
    held = "State_9" in "".join(person.window.files.texts.values())
    kept = (person.windows.settings.folder / "recovered").glob("*")
    assert held or any("State_9" in path.read_text() for path in kept)


def test_work_is_offered_again_where_the_journal_cannot_be_written(
    sit: Sit, outer: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = sit(outer)
    add(first, "SB1")
    die(first)
    person = sit()
    offer = offer_to(person)
    (row,) = offer.rows.values()

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(JournalFile, "write", full)
    person.click(row.recover)
    assert "State_9" in person.blueprint["SB1"].table
    (left,) = left_behind(person.windows.settings.folder / "journal")
    left.keep()


def test_the_last_journal_stays_where_a_newer_one_finds_no_room(
    sit: Sit, outer: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = sit(outer)
    add(first, "SB1")
    assert first.window.safety.journal.flush()

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr(JournalFile, "write", full)
        add(first, "SB1", "State_10")
        die(first)
    assert "1 state added" in words_of(offer_to(sit()))


def test_what_was_saved_in_the_last_moment_is_not_offered(sit: Sit, outer: Path) -> None:
    first = sit(outer)
    add(first, "SB1")
    assert first.window.safety.journal.flush()
    outer.write_text(first.window.session.texts[str(outer)])
    place = first.window.safety.journal._place
    assert place is not None
    place.let_go()
    person = sit()
    assert offer_recovery(person.windows, person.window) is None


def test_an_import_that_appears_leaves_a_broken_text_alone(sit: Sit, outer: Path) -> None:
    inner_of(outer).unlink()
    person = sit(outer)
    typed = OUTER.replace("{}", "{")
    person.window.session.write("Type", typed)
    inner_of(outer).write_text(INNER)
    look(person)
    assert person.window.session.texts[str(outer)] == typed
    person.window.session.write("Type", OUTER + "\n")
    person.until(lambda: "SB2" in person.blueprint.branches)


def test_the_question_stays_while_their_text_cannot_be_taken_yet(sit: Sit, outer: Path) -> None:
    person = sit(outer)
    person.window.session.write("Type", OUTER.replace("{}", "{"))
    theirs = INNER.replace("Up", "Higher")
    replaced(inner_of(outer), theirs)
    person.until(lambda: bar(person).startswith("inner.json"))
    person.click(person.window.safety.bar.theirs)
    assert bar(person).startswith("inner.json")
    person.window.session.history.undo()
    person.click(person.window.safety.bar.theirs)
    assert "Higher" in person.blueprint["SB2"].table["State_0"]


def test_a_blueprint_is_not_saved_over_what_it_imports(
    sit: Sit, outer: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    person = sit(outer)
    monkeypatch.setattr(Dialogs, "file_to_save", lambda *_: inner_of(outer))
    assert not person.window.files.save_as()
    assert "imports" in person.window.toast.words
    assert inner_of(outer).read_text() == INNER


def test_what_is_being_typed_comes_back_after_theirs_was_taken(sit: Sit, outer: Path) -> None:
    person = sit(outer)
    add(person, "SB1")
    replaced(outer, ALONE)
    person.until(lambda: bool(bar(person)))
    person.window.show_tab("Source")
    editor = person.window.source.editor
    editor.setFocus()
    person.type("x")
    person.window.safety.outside.take_theirs()
    assert person.window.session.texts[str(outer)] == ALONE
    person.window.session.history.undo()
    assert "x" in person.window.session.texts[str(outer)].split("{")[0]


def test_the_same_text_written_by_another_program_is_no_question(sit: Sit, outer: Path) -> None:
    person = sit(outer)
    add(person, "SB1")
    person.window.safety.outside.watcher.stop()
    outer.write_text(person.window.session.texts[str(outer)])
    assert person.window.files.save()
    assert person.window.menu_row.title == "outer.json"
