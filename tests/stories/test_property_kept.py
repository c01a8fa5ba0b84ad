"""A hazard or property that is typed and not added yet is in no save and no closing lost."""

from __future__ import annotations

from pathlib import Path

import pytest
from PySide6.QtCore import Qt

from smsl_studio.studio.document.files import auto_save
from smsl_studio.studio.document.files.auto_save import AutoSave
from smsl_studio.studio.features.inspection.claim_form import ClaimForm
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person
from tests.stories.test_inspection_page import no_offers, page
from tests.stories.test_several_files import answer

Key = Qt.Key
NAME, CONDITION = "Not both on a and c", "SB1/0 = a and SB1/1 = c"


@pytest.fixture
def file(tmp_path: Path) -> Path:
    """A procedure without hazards and properties."""
    path = tmp_path / "two.json"
    path.write_bytes((SAMPLES / "hanoi-2.json").read_bytes())
    return path


def typed(person: Person, name: str, kind: str = "Never: a condition") -> ClaimForm:
    """Type a property, and do not press Add."""
    person.ctrl(Key.Key_I)
    form = page(person).form
    person.click(page(person).add_empty)
    person.type(name)
    person.choose(form.kind, kind)
    person.type(CONDITION)
    no_offers(person)
    return form


@pytest.mark.parametrize(
    ("kind", "key"), [("Never: a condition", "_properties"), ("Hazard", "_hazards")]
)
def test_save_takes_over_what_is_typed(sit: Sit, file: Path, kind: str, key: str) -> None:
    person = sit(file)
    words = kind if kind.startswith("Never") else "Hazard: facts never together"
    form = typed(person, NAME, words)
    assert form.isVisible()
    person.ctrl(Key.Key_S)
    assert NAME in file.read_text()
    assert person.blueprint.documents[0].values[key][0]["name"] == NAME
    assert not page(person).writing.open
    assert person.window.toast.words == "Saved two.json."


def test_quit_asks_about_what_is_typed_and_saves_it(sit: Sit, file: Path) -> None:
    person = sit(file)
    typed(person, NAME)
    told: list[str] = []
    answer(person, "Save", told)
    person.ctrl(Key.Key_Q)
    assert told == ["two.json has unsaved changes."]
    assert NAME in file.read_text()
    assert not list(person.windows)


def test_what_cannot_be_added_is_said_when_saving_and_asked_about_when_closing(
    sit: Sit, file: Path
) -> None:
    person = sit(file)
    form = typed(person, "")
    before = file.read_bytes()
    person.ctrl(Key.Key_S)
    assert person.window.toast.words == (
        "two.json is saved already. The property in Inspection is not added yet: "
        "It has no name yet."
    )
    told: list[str] = []
    answer(person, "Cancel", told)
    assert not person.window.close()
    assert form.isVisible()
    assert form.first.text() == CONDITION
    answer(person, "Leave without it", told)
    assert person.window.close()
    assert told == ["The property in Inspection is not added yet: It has no name yet."] * 2
    assert file.read_bytes() == before


def test_a_form_in_which_only_a_kind_is_chosen_asks_nothing(sit: Sit, file: Path) -> None:
    person = sit(file)
    person.ctrl(Key.Key_I)
    person.click(page(person).add_empty)
    person.choose(page(person).form.kind, "Never: a condition")
    assert person.window.close()


def test_a_save_by_itself_does_not_close_the_form(
    sit: Sit, file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    person = sit(file)
    monkeypatch.setattr(auto_save, "losses", lambda _: ())
    person.select("SB1/State_aa")
    person.press(Key.Key_Delete)
    assert person.window.session.edited
    form = typed(person, NAME)
    person.windows.settings.autosave = True
    saving = AutoSave(person.window.session, person.window.files, person.windows.settings)
    assert saving.save()
    assert form.isVisible()
    assert form.first.text() == CONDITION
    assert NAME not in file.read_text()
