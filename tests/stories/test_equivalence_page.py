"""Comparing behaviour with another version, and states that behave alike."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from PySide6.QtCore import Qt

from smsl_studio.inspection.equivalence import equivalence
from smsl_studio.stop import heed
from smsl_studio.studio.features.draw.compare.revision_dialog import RevisionDialog
from smsl_studio.studio.features.draw.shape.shape_preview import ShapePreview
from smsl_studio.studio.features.inspection import look_line
from smsl_studio.studio.features.inspection.equivalence_page import EquivalencePage
from smsl_studio.studio.features.inspection.tab_line import EQUIVALENCE
from tests.git_folder import git_folder
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key = Qt.Key
TWINS: dict[str, Any] = {"SB": {
    "HEADER": {"INITIAL": "S_0", "ACTIVATING": "S_2"},
    "_states": {f"S_{name}": {"facts": [name[0]]} for name in ("0", "1", "1b", "2")},
    "S_0": {"go": "S_1"}, "S_1": {"on": "S_2", "other": "S_1b"},
    "S_1b": {"on": "S_2", "other": "S_1"}, "S_2": {"back": "S_1b"},
}}  # fmt: skip


def at_equivalence(sit: Sit, file: Path) -> Person:
    """Open a file, and choose the tab with the pointer."""
    person = sit(file)
    person.ctrl(Key.Key_I)
    tabs = person.window.features.inspection.panel.tabs
    person.click(tabs, tabs.tabRect(EQUIVALENCE).center())
    person.until(lambda: page(person).same.answer is not None)
    return person


def page(person: Person) -> EquivalencePage:
    return person.window.features.inspection.panel.equivalence


def answered(person: Person) -> None:
    person.until(lambda: page(person).look.answer is not None)


def compare_with(person: Person, file: Path) -> None:
    """Choose a file, as in its dialog."""
    person.window.features.draw.comparing.ask_file = lambda folder: file
    person.click(page(person).file)
    answered(person)


def test_another_file_of_the_same_behaviour(sit: Sit, tmp_path: Path) -> None:
    values = json.loads((SAMPLES / "hanoi-corrected.json").read_text("utf-8"))
    values["SB1"]["_comment"] = "the same"
    other = tmp_path / "same.json"
    other.write_text(json.dumps(values))
    person = at_equivalence(sit, SAMPLES / "hanoi-corrected.json")
    assert not page(person).both.isVisible()
    compare_with(person, other)
    assert page(person).verdict.text() == "Same behaviour as same.json"
    assert page(person).reason.text() == "27 configurations, all."
    assert not page(person).run.isVisible()
    assert "safe" not in page(person).verdict.text()


def test_the_shortest_run_is_lit_here_and_walked_on_both_sides(sit: Sit) -> None:
    person = at_equivalence(sit, SAMPLES / "hanoi-corrected.json")
    compare_with(person, SAMPLES / "hanoi.json")
    shown = page(person)
    assert shown.verdict.text() == "Another behaviour than hanoi.json"
    assert shown.reason.text() == (
        "After 6 operations the drawing has Op_2a, and hanoi.json has not."
    )
    assert shown.run.isVisible()
    assert shown.run.title.text() == "Shortest run to a difference"
    canvas = person.window.canvas
    assert canvas.marks.active == shown.run.lit.steps[0].configuration["SB1"]
    person.click(shown.run.step)
    assert canvas.marks.active == shown.run.lit.steps[1].configuration["SB1"]

    person.click(shown.both)
    dialog = person.window.features.draw.comparing.dialog
    assert dialog is not None
    runs = dialog.runs
    person.until(runs.isVisible)
    assert runs.last == 6
    before, after = dialog.before.canvas.marks, dialog.after.canvas.marks
    assert before.active == after.active == "State_aaa"
    for at in range(1, 7):
        person.click(runs.step)
        sides = (dialog.before.canvas.marks.active, dialog.after.canvas.marks.active)
        known = [side[min(at, len(side) - 1)].configuration["SB1"] for side in runs.steps]
        assert list(sides) == known
    assert sorted(map(len, runs.steps)) == [6, 7], "one of them has not the last operation"
    assert "not permitted" in runs.words.text()
    assert not runs.step.isEnabled()
    person.click(runs.back)
    assert runs.at == 5
    dialog.close()
    person.come_back()


def test_an_edit_takes_the_answer_away_and_it_is_asked_again(sit: Sit, tmp_path: Path) -> None:
    file = tmp_path / "twins.json"
    file.write_text(json.dumps(TWINS))
    person = at_equivalence(sit, file)
    person.click(page(person).saved)
    answered(person)
    assert page(person).verdict.text() == "Same behaviour as twins.json, as saved"
    person.window.canvas.setFocus()
    person.select("SB/S_0/go")
    person.press(Key.Key_Delete)
    assert page(person).verdict.text() == "twins.json, as saved: Changed since checked"
    assert page(person).look.answer is None
    person.click(page(person).again)
    answered(person)
    assert page(person).verdict.text() == "Another behaviour than twins.json, as saved"
    assert page(person).reason.text() == (
        "After 1 operation twins.json, as saved has go, and the drawing has not."
    )
    person.ctrl(Key.Key_Z)
    assert page(person).look.answer is None
    person.window.files.open(SAMPLES / "hfsm.json")
    assert page(person).verdict.text() == ""


def test_a_commit_of_git_is_compared(
    sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    git = git_folder(tmp_path, monkeypatch)
    file = tmp_path / "twins.json"
    file.write_text(json.dumps(TWINS))
    git("init", "-q")
    git("add", "twins.json")
    git("commit", "-q", "-m", "Draw it")
    person = at_equivalence(sit, file)
    person.click(page(person).revision)
    person.until(lambda: person.window.findChild(RevisionDialog) is not None)
    asking = person.window.findChild(RevisionDialog)
    assert asking is not None
    person.click(asking.compare)
    answered(person)
    assert page(person).verdict.text().startswith("Same behaviour as twins.json at ")


def test_a_comparison_that_lasts_is_called_off(
    sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def for_ever(*_: object, **__: object) -> None:
        while True:
            heed()

    monkeypatch.setattr(look_line, "PATIENCE", 0)
    person = at_equivalence(sit, SAMPLES / "hfsm.json")
    monkeypatch.setattr(equivalence, "equivalence", for_ever)
    person.window.features.draw.comparing.ask_file = lambda folder: SAMPLES / "hfsm.json"
    person.click(page(person).file)
    person.until(page(person).looking.isVisible)
    person.click(page(person).looking.cancel)
    assert page(person).verdict.text() == "hfsm.json: Stopped comparing"
    assert not page(person).look.works


def test_a_file_that_cannot_be_compared_says_why(sit: Sit, tmp_path: Path) -> None:
    lost = tmp_path / "lost.json"
    lost.write_text(json.dumps({"SB": {"HEADER": {"INITIAL": "Nowhere"}, "S_0": {}}}))
    person = at_equivalence(sit, SAMPLES / "hfsm.json")
    compare_with(person, lost)
    assert page(person).verdict.text() == "lost.json: not compared"
    assert "Nowhere" in page(person).reason.text()
    broken = tmp_path / "broken.json"
    broken.write_text("{")
    person.window.features.draw.comparing.ask_file = lambda folder: broken
    person.click(page(person).file)
    person.until(lambda: person.window.toast.isVisible())
    assert page(person).verdict.text() == "lost.json: not compared", "the former answer stays"


def test_states_that_cannot_be_told_apart_are_merged_after_a_preview(
    sit: Sit, tmp_path: Path
) -> None:
    file = tmp_path / "twins.json"
    file.write_text(json.dumps(TWINS))
    person = at_equivalence(sit, file)
    before = person.window.session.texts
    shown = page(person)
    assert not shown.merge.isEnabled()
    person.click_row(shown.rows, "S_1 and S_1b")
    assert shown.why.text() == (
        "S_1 and S_1b: the same facts, and the same operations from there on."
    )
    person.click(shown.merge)
    shapes = person.window.features.draw.shapes
    person.until(lambda: shapes.dialog is not None)
    preview = shapes.dialog
    assert isinstance(preview, ShapePreview)
    assert person.window.session.texts == before, "nothing is changed before it is applied"
    person.click(preview.apply)
    assert list(person.blueprint["SB"].table) == ["S_0", "S_1", "S_2"]
    assert person.steps()[-1] == "Merge S_1b into S_1"
    person.come_back()
    person.until(lambda: shown.same.answer == ())
    person.window.canvas.setFocus()
    person.ctrl(Key.Key_Z)
    assert person.window.session.texts == before


def test_states_with_other_facts_are_shown_and_not_merged(sit: Sit, tmp_path: Path) -> None:
    values = {"SB": {
        "HEADER": {"INITIAL": "S_00", "ACTIVATING": "S_11"}, "_facts": {"1": {"name": "light"}},
        "S_00": {"go": "S_01"}, "S_01": {"on": "S_11", "lamp": "S_02"},
        "S_02": {"on": "S_11", "lamp": "S_01"}, "S_11": {},
    }}  # fmt: skip
    file = tmp_path / "lamp.json"
    file.write_text(json.dumps(values))
    person = at_equivalence(sit, file)
    person.click_row(page(person).rows, "S_01 and S_02")
    assert page(person).why.text() == (
        "S_01 and S_02: they mean different things: light differs in them."
    )
    assert not page(person).merge.isEnabled()
