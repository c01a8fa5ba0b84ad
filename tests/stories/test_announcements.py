"""What a screen reader reads out by itself: run states, holds, questions, findings, messages."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtGui import QAccessible, QAction
from PySide6.QtWidgets import QDialog

from smsl_studio.studio.base.canvas.accessible_tree import CanvasAccessible
from smsl_studio.studio.base.rows import LINE
from smsl_studio.studio.features.draw.facts.fact_model import FactModel
from smsl_studio.studio.features.draw.find.palette import Palette
from smsl_studio.studio.shell.accessible_choice import ChoiceAccessible
from smsl_studio.studio.shell.frame.key_table import KeyTable
from tests.stories.at_tasks import NURSE, SURGEON, AtTasks, asking
from tests.stories.conftest import Heard, Sit
from tests.stories.person import SAMPLES

Key = Qt.Key


def test_findings_are_told_when_their_sum_changes(sit: Sit, heard: Heard) -> None:
    person = sit(SAMPLES / "hfsm.json")
    person.until_inspected()
    heard.clear()
    before = len(person.window.findings.findings)
    person.select("SB1/State000/Operation000")
    person.press(Key.Key_Delete)
    person.until_inspected()
    assert len(person.window.findings.findings) != before
    told = [words for words, _ in heard if words.startswith("Findings: ")]
    assert told == [f"Findings: {person.window.status_line.counts[3].text()}."]
    assert "warning" in told[0] or "error" in told[0]


def test_run_states_questions_and_holds_are_told(sit: Sit, heard: Heard, tmp_path: Path) -> None:
    path = asking(tmp_path, go={"confirm": ["surgeon"], "answer_within": 40.0})
    person = sit(path)
    at = AtTasks(person, SURGEON, NURSE)
    heard.clear()
    person.press(Key.Key_F5)
    person.until(lambda: at.people.has_task())
    person.until(lambda: any("Waiting" in words for words, _ in heard))
    card = at.people.card.card
    assert card is not None
    asked = [one for one in heard if card.question in one[0]]
    assert len(asked) == 1, "once, and not with each tick"
    assert asked[0][1], "a question interrupts"
    # The question is told in every mode, and not again when its card is shown.
    person.ctrl(Key.Key_1)
    person.press(Key.Key_F4)
    assert len([one for one in heard if card.question in one[0]]) == 1
    person.press(Key.Key_F8)
    person.until(lambda: at.run.phase == "stopped")
    stops = [one for one in heard if one[0].startswith("The run: Stopped.")]
    assert stops
    assert all(urgent for _, urgent in stops)
    assert len(stops[0][0]) > len("The run: Stopped. "), "with the sentence about it"


def test_a_refusal_interrupts_and_a_sentence_at_the_pointer_does_not(
    sit: Sit, heard: Heard
) -> None:
    person = sit(SAMPLES / "hfsm.json")
    heard.clear()
    person.select("SB1/State111")
    person.press(Key.Key_O)
    assert heard == [("No operation leaves State111.", False)]
    person.press(Key.Key_Delete)
    person.ctrl(Key.Key_2)
    person.ctrl(Key.Key_Z)
    assert [urgent for words, urgent in heard if "undo" in words.lower()] == [True]


def test_keys_of_the_canvas_say_what_is_missing(sit: Sit, heard: Heard) -> None:
    person = sit(SAMPLES / "hanoi.json")
    canvas = person.window.canvas
    canvas.setFocus()
    for key, words in (
        (Key.Key_O, "Select one state first"),
        (Key.Key_G, "Select one operation first"),
        (Key.Key_Return, "No fact of SB1 has a sub-SB"),
        (Key.Key_Right, "Nothing is selected."),
        (Key.Key_Space, "Nothing is selected."),
    ):
        heard.clear()
        person.press(key)
        told = [one for one, _ in heard]
        assert len(told) == 1, (key, told)
        assert told[0].startswith(words)
    person.select("SB1/State_aaa")
    heard.clear()
    person.press(Key.Key_O)
    person.press(Key.Key_G)
    assert not heard
    assert len(person.selected()) == 1


def test_a_search_that_finds_something_does_not_say_that_it_finds_nothing(
    sit: Sit, heard: Heard
) -> None:
    person = sit(begin=False)
    person.ctrl(Key.Key_K)
    palette = person.window.findChild(Palette)
    assert palette is not None
    person.type("tower of hanoi")
    rows = [row.text for row in palette.list.rows.rows]
    assert rows == ["Open sample hanoi-corrected.json: Tower of Hanoi, 3 disks"]
    assert palette.empty.text() == ""
    heard.clear()
    person.type("q")
    assert [words.partition(". ")[0] for words, _ in heard] == [
        "Nothing is called “tower of hanoiq”"
    ]


def test_the_row_that_is_marked_in_the_search_is_told(sit: Sit, heard: Heard) -> None:
    person = sit(SAMPLES / "hfsm.json")
    heard.clear()
    person.ctrl(Key.Key_K)
    assert [words.rpartition(", ")[2].startswith("1 of ") for words, _ in heard] == [True]
    heard.clear()
    person.type("110b")
    first = "Operation110B, SB1 / State110, 1 of 1"
    assert heard[-1] == (first, False)
    person.ctrl(Key.Key_A)
    person.type("110")
    heard.clear()
    rows = [row.text for row in person.window.command_palette.list.rows.rows if row.kind == LINE]
    for at in (1, 2, 1):
        person.press(Key.Key_Down if len(heard) < 2 else Key.Key_Up)
        words = heard[-1][0]
        assert words.startswith(rows[at])
        assert words.endswith(f", {at + 1} of {len(rows)}")
    assert len(heard) == 3
    person.press(Key.Key_Escape)
    assert len(heard) == 3


def test_a_comparison_is_told_in_one_sentence(sit: Sit, heard: Heard, tmp_path: Path) -> None:
    person = sit(SAMPLES / "hanoi.json")
    person.window.comparing.ask_file = lambda folder: SAMPLES / "hanoi-corrected.json"
    heard.clear()
    person.window.actions_table["compare_file"].trigger()
    dialog = person.window.comparing.dialog
    assert dialog is not None
    person.qtbot.waitExposed(dialog)
    told = [words for words, _ in heard if dialog.summary in words]
    assert len(told) == 1
    assert "2 changes" in told[0]
    assert len(heard) == 1


def test_names_are_words_and_one_thing_has_the_focus(sit: Sit) -> None:
    person = sit(SAMPLES / "hanoi.json")
    window = person.window
    for entry in window.findChildren(QAction):
        assert "\t" not in entry.text(), entry.text()
    combo = window.properties.header.initial
    found = ChoiceAccessible(combo)
    assert found.text(QAccessible.Text.Name).startswith("Initial state: ")
    related = [one.text(QAccessible.Text.Name) for one, _ in found.relations()]
    assert "Initial" in related
    facts = window.docks.panel("Facts").findChild(FactModel)
    assert facts is not None
    assert facts.lines[0].words.startswith("Fact 1, digit 0, ")
    person.select("SB1/State_aaa")
    canvas = CanvasAccessible(window.canvas)
    assert window.canvas.hasFocus()
    assert not canvas.state().focused, "the state has it"
    window.session.select(())
    assert canvas.state().focused


def test_a_finding_offers_its_fix_as_a_button(sit: Sit) -> None:
    person = sit(SAMPLES / "hanoi.json")
    person.until_inspected()
    findings = person.window.findings
    person.press(Key.Key_F3)
    first = findings.list.currentIndex().data(Qt.ItemDataRole.UserRole)
    assert first.fix is not None
    assert findings.fix_button.accessibleName() == f"Fix: {first.fix.words}"
    person.click(findings.fix_button)
    assert person.steps()[-1] == first.fix.words


def test_the_keys_are_a_table(sit: Sit) -> None:
    person = sit(SAMPLES / "hanoi.json")
    person.window.show_shortcuts()
    table = next(one.findChild(KeyTable) for one in person.window.findChildren(QDialog))
    assert table is not None
    found = {}
    for at in range(table.rowCount()):
        does, key = table.item(at, 0), table.item(at, 1)
        if does is not None and key is not None:
            found[does.text()] = key.text()
    assert found["Rename"] == "F2"
    assert "Ctrl+K" in found.values()
