"""A drawing that is just being drawn: what is only missing yet is no mistake."""

from __future__ import annotations

from pathlib import Path

import pytest
from PySide6.QtCore import Qt

from smsl_studio.blueprint import editing
from smsl_studio.inspection.rules.finding import Severity
from smsl_studio.studio.document.files.dialogs import Dialogs
from smsl_studio.studio.features.draw.panels.unfinished import NOT_YET
from tests.stories.conftest import Sit
from tests.stories.person import Person

Key = Qt.Key


def begun(sit: Sit) -> Person:
    """Somebody who has drawn two states, and no operation between them yet."""
    person = sit()
    person.double_click_canvas(person.window.canvas.rect().center())
    person.type("State_0")
    person.press(Key.Key_Return)
    person.press(
        Key.Key_N, [Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier]
    )
    person.type("State_1")
    person.press(Key.Key_Return)
    assert list(person.blueprint["SB1"].table) == ["State_0", "State_1"]
    person.window.canvas.setFocus()
    person.until_inspected()
    return person


def severities(person: Person) -> set[Severity]:
    findings = person.window.findings.findings
    return {one.severity for one in findings if one.rule in NOT_YET}


def test_what_is_missing_is_a_soft_list_without_a_sign(sit: Sit) -> None:
    person = begun(sit)
    window = person.window
    assert severities(person) == {Severity.NOTE}
    assert window.findings.summary.text() == "1 note, 2 to finish"
    assert window.status_line.counts[3].text() == "1 note, 2 to finish"
    assert "approval" not in window.findings.summary.text()
    assert not window.canvas.marks.findings, "no sign on the canvas"
    assert not window.features.approval.badge.isVisible(), "there is nothing to approve"
    missing = [one for one in window.findings.findings if one.rule in NOT_YET]
    assert [one.fix for one in missing] == [None, None], "no fix deletes what is just drawn"
    row = person.row(window.findings.list, "R10")
    assert str(row.data()).startswith("To finish: R10")


@pytest.mark.parametrize("how", ["check", "next", "run"])
def test_a_check_or_a_run_shows_the_mistakes_as_such(sit: Sit, how: str) -> None:
    person = begun(sit)
    window = person.window
    if how == "check":
        person.click(window.findings.check_button)
    else:
        person.press(Key.Key_F3 if how == "next" else Key.Key_F5)
    assert severities(person) == {Severity.ERROR}
    assert not window.findings.check_button.isVisible()
    assert window.findings.summary.text() == "2 errors block approval"
    person.window.set_mode("draw")
    window.session.edit("Add", lambda bp: editing.add_state(bp, "SB1", "State_2"))
    person.until_inspected()
    assert severities(person) == {Severity.ERROR}, "it stays checked"


def test_saving_shows_them_too_and_the_badge(
    sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    person = begun(sit)
    monkeypatch.setattr(Dialogs, "file_to_save", lambda *_: tmp_path / "new.json")
    person.ctrl(Key.Key_S)
    person.until_inspected()
    assert severities(person) == {Severity.ERROR}
    assert person.window.features.approval.badge.isVisible()


def test_another_new_drawing_is_quiet_again(sit: Sit, monkeypatch: pytest.MonkeyPatch) -> None:
    person = begun(sit)
    person.click(person.window.findings.check_button)
    monkeypatch.setattr(Dialogs, "unsaved", lambda *_: "discard")
    person.ctrl(Key.Key_N)
    edit = person.window.session.edit
    edit("Add a state", lambda bp: editing.add_state(bp, "SB1", "State_0"))
    edit("Add another", lambda bp: editing.add_state(bp, "SB1", "State_1"))
    person.until_inspected()
    assert severities(person) == {Severity.NOTE}


def test_a_file_is_never_quiet(sit: Sit, tmp_path: Path) -> None:
    path = tmp_path / "file.json"
    path.write_text('{"SB1": {"State_0": {}, "State_1": {}}}')
    person = sit(path)
    person.until_inspected()
    assert severities(person) == {Severity.ERROR}
    assert person.window.features.approval.badge.isVisible()


def test_a_real_mistake_is_one_in_a_new_drawing_too(sit: Sit) -> None:
    person = begun(sit)
    edit = person.window.session.edit
    edit("Add", lambda bp: editing.add_state(bp, "SB1", "State_00"))
    person.until_inspected()
    found = {one.rule: one.severity for one in person.window.findings.findings}
    assert found["R05"] is Severity.WARNING
    summary = person.window.findings.summary.text()
    assert "warning" in summary
    assert "to finish" in summary
    assert "approval" not in summary
