"""A save of several files was interrupted, or another program writes during it: the person
decides."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import pytest

from smsl_studio.blueprint import editing
from smsl_studio.smsl import outputs, together
from smsl_studio.smsl.pending_saves import pending_saves
from smsl_studio.smsl.together import save_together
from smsl_studio.studio.shell.application import offer_recovery
from tests.stories.conftest import Sit
from tests.stories.person import Person
from tests.stories.test_recovery import die, offer_to
from tests.stories.test_several_files import INNER, answer

OUTER = '{\n  "_imports": ["inner.json"],\n  "SB1": {"State_0": {}}\n}\n'
NEW_OUTER, NEW_INNER = OUTER.replace("State_0", "State_1"), INNER.replace("Up", "Higher")


@pytest.fixture
def outer(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A file that has its new text, and imports one that has not."""
    path, inner = tmp_path / "outer.json", tmp_path / "inner.json"
    path.write_text(OUTER)
    inner.write_text(INNER)
    interrupt(monkeypatch, [(NEW_OUTER, path), (NEW_INNER, inner)])
    assert texts(path) == [NEW_OUTER, INNER]
    return path


def interrupt(monkeypatch: pytest.MonkeyPatch, pairs: list[tuple[str, Path]]) -> None:
    """A save that ends before its last file is replaced."""
    replace = os.replace

    def dies(source: Any, target: Any) -> None:
        if os.fspath(target) == str(pairs[-1][1]):
            raise KeyboardInterrupt
        replace(source, target)

    with monkeypatch.context() as patch:
        patch.setattr(os, "replace", dies)
        with pytest.raises(KeyboardInterrupt):
            save_together(pairs)


def texts(outer: Path) -> list[str]:
    return [outer.read_text(), outer.with_name("inner.json").read_text()]


def opened(person: Person, path: Path, words: str) -> list[str]:
    """Open a file and press a button of the question that comes up; what it said."""
    told: list[str] = []
    answer(person, words, told)
    person.window.open_path(path)
    return told


def test_an_interrupted_save_is_finished_where_the_person_says_so(sit: Sit, outer: Path) -> None:
    person = sit()
    (said,) = opened(person, outer, "Finish the save")
    assert said.startswith("The program ended on ")
    assert said.endswith(" while it was saving outer.json and inner.json.")
    assert texts(outer) == [NEW_OUTER, NEW_INNER]
    assert list(pending_saves()) == []
    assert "Higher" in person.blueprint["SB2"].table["State_0"]
    assert [path.name for path in outer.parent.glob(".*")] == []


def test_an_interrupted_save_is_undone_where_the_person_says_so(sit: Sit, outer: Path) -> None:
    person = sit()
    assert opened(person, outer.with_name("inner.json"), "Undo it")
    assert texts(outer) == [OUTER, INNER]
    assert list(pending_saves()) == []
    assert "Up" in person.blueprint["SB2"].table["State_0"]
    assert person.window.menu_row.title == "inner.json"


def test_where_nothing_is_decided_nothing_is_opened_or_written(sit: Sit, outer: Path) -> None:
    person = sit()
    before = {path.name: path.read_bytes() for path in outer.parent.iterdir()}
    assert opened(person, outer, "Cancel")
    assert person.window.menu_row.title == "untitled.json"
    assert {path.name: path.read_bytes() for path in outer.parent.iterdir()} == before
    assert len(list(pending_saves())) == 1
    assert opened(person, outer, "Undo it"), "and it is asked again"


def test_recovering_unsaved_work_asks_about_an_interrupted_save_first(
    sit: Sit, outer: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    person = sit()
    opened(person, outer, "Undo it")
    person.window.session.edit("Add", lambda bp: editing.add_state(bp, "SB1", "State_9"))
    die(person)
    interrupt(monkeypatch, [(NEW_OUTER, outer), (NEW_INNER, outer.with_name("inner.json"))])
    person = sit()
    offer = offer_to(person)
    (row,) = offer.rows.values()
    answer(person, "Cancel")
    person.click(row.recover)
    assert person.window.menu_row.title == "untitled.json"
    assert row.recover.isEnabled(), "it is still offered"
    answer(person, "Finish the save")
    person.click(row.recover)
    assert texts(outer) == [NEW_OUTER, NEW_INNER]
    assert person.window.menu_row.title == "outer.json edited"
    assert offer_recovery(person.windows, person.window) is None


# --- another program writes while the window saves -----------------------------------------------


def another_program(monkeypatch: pytest.MonkeyPatch, path: Path, writes: list[str]) -> None:
    """One that writes each of these texts right before the file would be replaced."""
    put = outputs.put

    def late(part: Path, target: Path, *more: Any) -> None:
        if target == path and writes:
            fresh = path.with_name("fresh.tmp")
            fresh.write_text(writes.pop(0))
            fresh.replace(path)
        put(part, target, *more)

    monkeypatch.setattr(outputs, "put", late)
    monkeypatch.setattr(together, "put", late)


@pytest.mark.parametrize(("words", "also_inner"), [("Cancel", False), ("Save over it", True)])
def test_what_another_program_writes_in_mid_save_is_asked_about(
    sit: Sit, outer: Path, monkeypatch: pytest.MonkeyPatch, words: str, also_inner: bool
) -> None:
    person = sit()
    opened(person, outer, "Undo it")
    person.window.session.edit("Add", lambda bp: editing.add_state(bp, "SB1", "State_9"))
    if also_inner:
        person.window.session.edit("Add", lambda bp: editing.add_state(bp, "SB2", "State_9"))
    theirs = OUTER + "\n"
    another_program(monkeypatch, outer, [theirs])
    told: list[str] = []
    answer(person, words, told)
    saved = person.window.files.save()
    assert told == ["outer.json was changed outside this window since it was read."]
    assert saved is (words == "Save over it")
    assert ("State_9" in outer.read_text()) is saved
    assert saved or texts(outer) == [theirs, INNER]
    assert not saved or ("State_9" in texts(outer)[1]) is also_inner


def test_a_program_that_writes_without_end_keeps_the_window_from_saving(
    sit: Sit, outer: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    person = sit()
    opened(person, outer, "Undo it")
    person.window.session.edit("Add", lambda bp: editing.add_state(bp, "SB1", "State_9"))
    another_program(monkeypatch, outer, [OUTER] * 100)
    assert not person.window.files.save()
    assert "another program has written it" in person.window.toast.words
    assert texts(outer) == [OUTER, INNER]
