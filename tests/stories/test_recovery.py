"""Unsaved work when the program ended, as the person finds it at the next start."""

from __future__ import annotations

import shutil
from pathlib import Path

from PySide6.QtWidgets import QLabel

from smsl_studio.blueprint import editing
from smsl_studio.studio.document.journal.entry import JournalEntry, KeptText, encode
from smsl_studio.studio.document.journal.leftovers import left_behind
from smsl_studio.studio.document.journal.offer import RecoveryOffer
from smsl_studio.studio.document.journal.place import JournalFile, folder_of
from smsl_studio.studio.shell.application import offer_recovery
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person


def copy_of(name: str, folder: Path) -> Path:
    return Path(shutil.copy(SAMPLES / name, folder / name))


def add(person: Person, name: str) -> None:
    person.window.session.edit(f"Add {name}", lambda bp: editing.add_state(bp, "SB1", name))


def die(person: Person) -> None:
    """What is left of a window when its program ends at once."""
    person.window.safety.journal.leave_behind()
    person.window.session.history.setClean()
    person.window.close()


def offer_to(person: Person) -> RecoveryOffer:
    offer = offer_recovery(person.windows, person.window)
    assert offer is not None
    return offer


def words_of(offer: RecoveryOffer) -> str:
    return " | ".join(label.text() for label in offer.findChildren(QLabel))


def test_nothing_is_offered_after_a_clean_end(sit: Sit, tmp_path: Path) -> None:
    person = sit(copy_of("hfsm.json", tmp_path))
    add(person, "State_new")
    person.until(lambda: person.window.safety.journal.safe == person.window.safety.journal.changes)
    assert person.window.files.save()
    assert person.window.close()
    again = sit()
    assert offer_recovery(again.windows, again.window) is None
    journals = folder_of(again.windows.settings.folder)
    assert list(journals.glob("*.journal")) == []


def test_unsaved_work_is_offered_with_what_it_brings_and_recovered(
    sit: Sit, tmp_path: Path
) -> None:
    path = copy_of("hfsm.json", tmp_path)
    before = path.read_bytes()
    first = sit(path)
    add(first, "State010")
    die(first)
    person = sit()
    offer = offer_to(person)
    assert "hfsm.json" in words_of(offer)
    assert "1 state added" in words_of(offer)
    (row,) = offer.rows.values()
    person.click(row.recover)
    assert not offer.isVisible()
    assert "State010" in person.blueprint["SB1"].table
    assert person.window.menu_row.title == "hfsm.json edited"
    assert path.read_bytes() == before
    assert person.window.safety.journal.path is not None, (
        "what was recovered is kept from the start"
    )
    person.window.canvas.setFocus()
    person.window.session.history.undo()
    assert person.window.menu_row.title == "hfsm.json", "back to what stands on the disk"


def test_what_is_decided_later_is_offered_again_and_what_is_discarded_is_not(
    sit: Sit, tmp_path: Path
) -> None:
    first = sit(copy_of("hfsm.json", tmp_path))
    add(first, "State010")
    die(first)
    person = sit()
    offer_to(person).reject()
    offer = offer_to(person)
    (row,) = offer.rows.values()
    person.click(row.discard)
    assert offer.isVisible()
    assert row.discard.text() == "Discard for good"
    person.click(row.discard)
    assert offer_recovery(person.windows, person.window) is None


def test_several_windows_are_offered_each_for_itself(sit: Sit, tmp_path: Path) -> None:
    for name in ("hfsm.json", "hanoi.json"):
        one = sit(copy_of(name, tmp_path))
        add(one, "State_new")
        die(one)
    person = sit()
    offer = offer_to(person)
    for row in list(offer.rows.values()):
        person.click(row.recover)
    shown = [
        window for window in person.windows if "State_new" in window.session.blueprint["SB1"].table
    ]
    assert {window.name for window in shown} == {"hfsm.json", "hanoi.json"}
    for window in shown:
        window.session.history.setClean()


def test_a_text_that_does_not_read_is_recovered_as_it_was_typed(sit: Sit, tmp_path: Path) -> None:
    path = copy_of("hfsm.json", tmp_path)
    first = sit(path)
    typed = path.read_text().replace("{", "", 1)
    first.window.session.write("Type", typed)
    die(first)
    person = sit()
    offer = offer_to(person)
    assert "cannot be read" in words_of(offer)
    (row,) = offer.rows.values()
    person.click(row.recover)
    assert person.window.session.broken is not None
    assert person.window.session.texts[str(path)] == typed
    assert person.window.docks.right_tabs.current == "Source"


def test_work_that_was_never_saved_comes_back_without_a_file(sit: Sit) -> None:
    first = sit()
    add(first, "State0")
    die(first)
    person = sit()
    offer = offer_to(person)
    assert "Never saved: 1 state and 0 operations" in words_of(offer)
    (row,) = offer.rows.values()
    person.click(row.recover)
    assert person.window.files.path is None
    assert person.window.menu_row.title == "untitled.json edited"


def test_a_file_that_has_gone_comes_back_from_what_was_kept(sit: Sit, tmp_path: Path) -> None:
    path = copy_of("hfsm.json", tmp_path)
    first = sit(path)
    add(first, "State010")
    die(first)
    path.unlink()
    person = sit()
    offer = offer_to(person)
    assert "no longer there" in words_of(offer)
    (row,) = offer.rows.values()
    person.click(row.recover)
    assert person.window.menu_row.title == "hfsm.json edited"
    assert person.window.files.save()
    assert "State010" in path.read_text()


def test_a_journal_from_anybody_does_no_harm(sit: Sit, tmp_path: Path) -> None:
    person = sit()
    folder = folder_of(person.windows.settings.folder)
    for kept in (
        KeptText("/nowhere/\ud800.json", "{"),
        KeptText("x" * 3000, "\ud800"),
        KeptText("", ""),
    ):
        place = JournalFile.take(folder)
        place.write(
            encode(JournalEntry("a", "/nowhere/" + "y" * 3000, kept.file, "now", 1, (kept,)))
        )
        place.let_go()
    offer = offer_to(person)
    for row in list(offer.rows.values()):
        person.click(row.recover)
    for window in person.windows:
        window.session.history.setClean()
    assert left_behind(folder) == ()


def test_a_text_of_a_file_that_is_imported_no_longer_is_put_aside(sit: Sit, tmp_path: Path) -> None:
    path, other = copy_of("hfsm.json", tmp_path), tmp_path / "other.json"
    person = sit()
    folder = folder_of(person.windows.settings.folder)
    place = JournalFile.take(folder)
    texts = (KeptText(str(other), '{"SB9": {"State_0": {}}}'),)
    place.write(encode(JournalEntry("hfsm.json", str(path), str(path), "", 1, texts)))
    place.let_go()
    (row,) = offer_to(person).rows.values()
    person.click(row.recover)
    assert "other.json" in person.window.toast.words
    (aside,) = (person.windows.settings.folder / "recovered").iterdir()
    assert aside.read_text() == texts[0].text
