"""States with words for names: their letters are no facts, and the window says what they miss."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from PySide6.QtCore import QPoint, Qt

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.plain_words import is_read_by_letters, read_by_letters
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import EditRefused
from smsl_studio.inspection.rules.finding import Severity
from smsl_studio.smsl.json_form import parse_json
from tests.stories.at_outline import texts
from tests.stories.conftest import Sit
from tests.stories.person import Person

Key = Qt.Key
SUB = {"HEADER": {"NUM_FACTS": 1}, "State0": {"a": "State1"}, "State1": {"b": "State0"}}
BASE = {
    "HEADER": {"INITIAL": "State000", "ACTIVATING": "State111", "NUM_FACTS": 3,
               "SUB_SBS": {"SB2": 1}},
    "State000": {"a": "State010"}, "State010": {"b": "State111"}, "State111": {"c": "State000"},
}  # fmt: skip


def read(sb1: object) -> Blueprint:
    return read_blueprint(parse_json(json.dumps({"SB1": sb1, "SB2": SUB}, indent=1), "words.json"))


@pytest.fixture
def person(sit: Sit, tmp_path: Path) -> Person:
    path = tmp_path / "words.json"
    path.write_text(json.dumps({"SB1": BASE, "SB2": SUB}, indent=1))
    return sit(path)


def add(person: Person, name: str, at: QPoint) -> None:
    person.double_click_canvas(at)
    person.type(name)
    person.press(Key.Key_Return)


def test_the_first_fix_of_a_word_gives_it_values_and_detaches_nothing(person: Person) -> None:
    add(person, "Patient ready", QPoint(120, 560))
    person.until_inspected()
    window = person.window
    findings = window.findings.findings
    fixes = [one.fix.words for one in findings if one.fix is not None]
    assert not [words for words in fixes if "Detach" in words]
    person.select("SB1/State000")
    person.select("SB1/Patient ready")
    card = window.features.draw.fix_card
    person.until(card.isVisible)
    assert "Patient ready 0 0 1" in card.fix.toolTip()
    person.click(card.fix)
    branch = person.blueprint["SB1"]
    assert branch.facts("Patient ready") == ("0", "0", "1")
    assert branch.facts("State010") == ("0", "1", "0")
    assert branch.subs == {1: "SB2"}
    person.until_inspected()
    assert not [one for one in findings_of(person) if one in ("R05", "R07")]


def findings_of(person: Person) -> list[str]:
    return [one.rule for one in person.window.findings.findings]


def test_properties_show_the_values_of_every_state_and_whence_they_are(person: Person) -> None:
    person.select("SB1/State010")
    form = person.window.properties.state
    line = form.line("facts")
    assert line.isVisible()
    assert form.values.placeholderText() == "0, 1, 0"
    assert line.hint.text() == "From the name."
    add(person, "Patient ready", QPoint(120, 560))
    assert form.values.placeholderText() == "a, d, y"
    assert line.hint.text() == "The letters of the name. Type its values."
    person.write(form.values, "0, 1")
    assert "3 values" in line.refusal.text()
    person.write(form.values, "0, 1, 1")
    assert person.blueprint["SB1"].facts("Patient ready") == ("0", "1", "1")
    assert form.values.text() == "0, 1, 1"
    assert line.hint.text() == "Given here."
    person.ctrl(Key.Key_Z)
    assert person.blueprint["SB1"].facts("Patient ready") == ("a", "d", "y")


def test_a_refused_text_is_told_when_another_state_is_clicked_and_comes_back(
    person: Person,
) -> None:
    person.select("SB1/State010")
    form, toast = person.window.properties.state, person.window.toast
    person.write(form.values, "0, 1")
    assert "3 values" in form.line("facts").refusal.text()
    person.select("SB1/State111")
    assert form.values.text() == ""
    assert "“0, 1” is not the Fact values of State010: it was refused." in toast.words
    assert "3 values" in toast.words
    person.click(toast.button)
    assert person.selected() == ["SB1/State010"]
    assert (form.values.text(), form.values.hasFocus()) == ("0, 1", True)
    person.write(form.values, "0, 1, 1")
    assert person.blueprint["SB1"].facts("State010") == ("0", "1", "1")
    person.select("SB1/State111")
    assert toast.words == "", "it is told once"


def test_a_refused_text_is_told_where_nothing_is_selected_then(person: Person) -> None:
    person.select("SB1/State010")
    toast = person.window.toast
    person.write(person.window.properties.state.values, "0, 1")
    person.click_canvas(QPoint(20, person.window.canvas.height() - 20))
    assert person.selected() == []
    assert "“0, 1” is not the Fact values of State010" in toast.words
    toast.hide()
    person.select("SB1/State010")
    person.select("SB1/State111")
    assert toast.words == ""


def test_a_new_state_whose_values_nobody_gave_says_so(person: Person) -> None:
    person.window.session.edit(
        "Give", lambda bp: editing.give_values(bp, "SB1", {"State111": ["1", "1", "0"]})
    )
    add(person, "Patient ready", QPoint(120, 560))
    assert person.blueprint["SB1"].facts("Patient ready") == ("0", "0", "1")
    assert "Patient ready got the free fact values 0 0 1" in person.window.toast.words


def test_a_word_stays_found_until_it_has_values(sit: Sit) -> None:
    person = sit()
    add(person, "Idle", QPoint(300, 300))
    add(person, "Done", QPoint(500, 300))
    person.until_inspected()
    assert "R05" in findings_of(person)
    person.window.session.edit(
        "Name", lambda bp: editing.set_note(bp, "SB1", "_facts", "0", {"name": "disk"})
    )
    person.until_inspected()
    (found,) = [one for one in person.window.findings.findings if one.rule == "R05"]
    assert found.severity is Severity.NOTE
    assert found.fix is not None
    person.window.findings.fix(found)
    assert person.blueprint["SB1"].facts("Done") == ("1",)
    person.until_inspected()
    assert "R05" not in findings_of(person)


@pytest.mark.parametrize("names", [("Idle",), ("Off",), ("Idle", "Homing"), ("Idle", "Done")])
def test_names_that_are_words_show_no_facts_anywhere(sit: Sit, names: tuple[str, ...]) -> None:
    person = sit()
    window = person.window
    for at, name in enumerate(names):
        add(person, name, QPoint(200 + 250 * at, 300))
    assert texts(window.outline.tree) == ["SB1"]
    assert window.facts.first.isVisible()
    assert window.facts.none.text() == "No facts yet."
    person.select(f"SB1/{names[0]}")
    form = window.properties.state
    assert not form.chips.isVisible()
    assert form.line("facts").hint.text() in ("None yet. Type its values.",
                                              "None: the name is its only fact.")  # fmt: skip
    assert not window.properties.header.facts


def test_the_first_fact_of_words_stands_beside_the_names(sit: Sit) -> None:
    person = sit()
    add(person, "Idle", QPoint(200, 300))
    person.click(person.window.facts.first)
    card = person.window.facts.card
    assert "1 state keeps its name" in card.words.text()
    person.click(card.agree)
    branch = person.blueprint["SB1"]
    assert (list(branch.table), branch.facts("Idle")) == (["Idle"], ("0",))
    assert texts(person.window.outline.tree) == ["SB1", "Fact 1"]
    person.ctrl(Key.Key_Z)
    assert texts(person.window.outline.tree) == ["SB1"]


def test_values_are_given_to_all_or_to_none() -> None:
    before = read(BASE)
    after = editing.give_values(before, "SB1", {"State111": ["1", "1", "0"]})
    assert [after["SB1"].facts(state) for state in BASE if state != "HEADER"] == [
        ("0", "0", "0"), ("0", "1", "0"), ("1", "1", "0")]  # fmt: skip
    assert editing.give_values(before, "SB1", {"State010": ["0", "1", "0"]}) is before
    for values in (["1"], ["1", "", "0"], []):
        with pytest.raises(EditRefused):
            editing.give_values(before, "SB1", {"State111": values})
    with pytest.raises(EditRefused):
        editing.give_values(before, "SB1", {"State9": ["1", "1", "0"]})


@pytest.mark.parametrize(
    "names", [("Diskab", "Diskba"), ("aabb", "abab"), ("State_ab", "State_ba")]
)
def test_letters_that_are_meant_are_no_words(names: tuple[str, str]) -> None:
    one, two = names
    header = {"NUM_FACTS": 4 if len(one) == 4 else 2}
    assert not read_by_letters(read({"HEADER": header, one: {"x": two}, two: {}})["SB1"])


@pytest.mark.parametrize(
    "names",
    [
        ("Idle", "Done"),
        ("State_01", "State_11", "Patient ready"),
        ("abcd", "bacd", "Stop"),
        ("up", "on", "Idle", "State_ab"),
        ("a1", "b0"),
    ],
)
def test_one_state_is_a_word_if_it_is_among_all_that_are(names: tuple[str, ...]) -> None:
    for facts in range(1, 6):
        branch = read({"HEADER": {"NUM_FACTS": facts}, **{name: {} for name in names}})["SB1"]
        words = tuple(name for name in names if is_read_by_letters(branch, name))
        assert words == read_by_letters(branch), facts
