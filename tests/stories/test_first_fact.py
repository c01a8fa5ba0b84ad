"""The first fact of states with words for names: by the button Sub-SB, by keys, by the palette."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QMenu

from smsl_studio.blueprint.plain_words import told_facts
from tests.stories.conftest import Sit
from tests.stories.person import Person

Key = Qt.Key
WORDS = {"Idle": {"home": "Homed"}, "Homed": {"pick": "Picked"}, "Picked": {"drop": "Idle"}}


@pytest.fixture
def person(sit: Sit, tmp_path: Path) -> Person:
    path = tmp_path / "cell.json"
    path.write_text(json.dumps({"SB1": WORDS}, indent=1))
    return sit(path)


def test_the_button_sub_sb_offers_a_new_fact_where_there_is_none(person: Person) -> None:
    window = person.window
    window.actions_table["sub_sb"].trigger()
    menu = QApplication.activePopupWidget()
    assert isinstance(menu, QMenu)
    assert [one.text() for one in menu.actions()] == ["A new fact"]
    (inner,) = (one.menu() for one in menu.actions())
    assert isinstance(inner, QMenu)
    inner.actions()[-1].trigger()
    menu.close()
    person.come_back()
    branch = person.blueprint["SB1"]
    assert list(branch.table) == ["Idle", "Homed", "Picked"], "words keep their names"
    assert dict(branch.subs) == {0: "SB2"}
    assert told_facts(branch) == 1
    person.until_inspected()
    assert "R07" not in [one.rule for one in window.findings.findings]
    assert person.steps() == ["Add a fact to SB1 and attach SB2 to it"]
    window.canvas.setFocus()
    person.ctrl(Key.Key_Z)
    assert "SB2" not in person.blueprint.branches
    assert told_facts(person.blueprint["SB1"]) == 0


def test_the_first_fact_is_added_by_keys_alone(person: Person) -> None:
    facts = person.window.facts
    person.ctrl(Key.Key_T)
    person.until(facts.first.hasFocus)
    person.press(Key.Key_Return)
    person.until(facts.card.isVisible)
    person.press(Key.Key_Return)
    person.until(lambda: told_facts(person.blueprint["SB1"]) == 1)
    person.press(Key.Key_Escape)
    person.ctrl(Key.Key_T)
    assert person.window.canvas.hasFocus()
    person.ctrl(Key.Key_T)
    assert facts.view.hasFocus()


def test_the_palette_knows_how_to_add_a_fact(person: Person) -> None:
    facts = person.window.facts
    person.ctrl(Key.Key_K)
    person.type("add fact")
    person.press(Key.Key_Return)
    person.until(facts.card.isVisible)
    assert person.window.docks.left_shown()
    person.press(Key.Key_Return)
    person.until(lambda: told_facts(person.blueprint["SB1"]) == 1)


def test_f2_says_why_it_renames_nothing(person: Person) -> None:
    canvas = person.window.canvas
    person.press(Key.Key_F2)
    assert canvas.overlays.word.text.startswith("Nothing is selected")
    person.ctrl(Key.Key_A)
    person.press(Key.Key_F2)
    assert "select it alone first" in canvas.overlays.word.text
    assert list(person.blueprint["SB1"].table) == ["Idle", "Homed", "Picked"]
