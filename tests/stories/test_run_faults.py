"""Faults by a dialog, and a script of what was done by hand."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from PySide6.QtCore import Qt

from smsl_studio import front
from smsl_studio.front.script.lines import read_script
from smsl_studio.runlog.events import Commanded, Disturbed, FaultInjected, Held
from smsl_studio.studio.document.files import dialogs
from smsl_studio.studio.features.run.fault_dialog import FaultDialog
from smsl_studio.studio.running import operation_time
from tests.stories.at_run import AtRun
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key = Qt.Key
SET = "A fact changes, until an operation writes it"
HANOI, HFSM = SAMPLES / "hanoi-corrected.json", SAMPLES / "hfsm.json"


def _dialog(run: AtRun) -> FaultDialog:
    """Open the dialog with its key."""
    run.person.press(Key.Key_I, (Qt.KeyboardModifier.ControlModifier,
                                 Qt.KeyboardModifier.ShiftModifier))  # fmt: skip
    found = run.person.window.features.run.faults
    assert found is not None
    run.person.until(found.isVisible)
    return found


def _choose(person: Person, dialog: FaultDialog, **words: str) -> None:
    for name, text in words.items():
        combo = getattr(dialog, name)
        if combo.currentText() != text:
            person.choose(combo, text)


def _line(dialog: FaultDialog) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(dialog.script.text())
    return found


def _paused(sit: Sit, monkeypatch: pytest.MonkeyPatch, path: Path = HANOI) -> AtRun:
    """A run that is paused in the middle of its first operation."""
    run = AtRun(sit(path))
    monkeypatch.setattr(operation_time, "USUAL", 1e6)
    run.choose("table")
    run.person.press(Key.Key_F5)
    run.until_runs()
    run.person.press(Key.Key_F6)
    run.until_phase("Paused")
    monkeypatch.setattr(operation_time, "USUAL", 0.0)
    run.as_fast_as_it_goes()
    return run


def _same_again(run: AtRun, script: Path, blueprint: Path = HANOI, **asked: Any) -> None:
    """The script without a window makes the same run."""
    read = front.read(blueprint)
    again = front.run(read, script=read_script(script, read), **asked)
    told = [event.line() for event in run.events]
    assert [event.line() for event in again.events][: len(told)] == told


def _save(run: AtRun, monkeypatch: pytest.MonkeyPatch, path: Path) -> None:
    monkeypatch.setattr(dialogs, "ask_to_save", lambda *_: (str(path), ""))
    run.person.click(run.pane.scene.script)
    assert path.exists()


def test_a_fact_changes_now_and_the_run_holds(
    sit: Sit, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    run = _paused(sit, monkeypatch)
    dialog = _dialog(run)
    _choose(run.person, dialog, fault=SET, fact="Fact 3", value="b", moment="Now")
    assert _line(dialog) == {"at": 0.0, "do": "inject", "fault": "set", "fact": "SB1/2",
                             "value": "b", "by": run.pane.run.who()}  # fmt: skip
    assert dialog.undone.text().startswith("Op_1c writes every fact of SB1 when it ends")
    run.person.click(dialog.inject)
    run.person.until(lambda: dialog.said.text() == "Injected at 0.00 s: set.")
    _choose(run.person, dialog, fault="A fact is read wrongly", fact="Fact 3", value="b")
    assert not dialog.undone.text()
    assert _line(dialog) == {"at": 0.0, "do": "disturb", "target": "SB1/2", "kind": "stuck",
                             "value": "b", "by": run.pane.run.who()}  # fmt: skip
    run.person.click(dialog.inject)
    run.person.until(lambda: dialog.said.text() == "Disturbed at 0.00 s: SB1/2 stuck.")
    run.person.click(dialog.close_button)
    run.person.press(Key.Key_F5)
    run.until_phase("Fault hold")
    _save(run, monkeypatch, tmp_path / "by-hand.jsonl")
    _same_again(run, tmp_path / "by-hand.jsonl")


def test_a_fault_waits_for_the_end_of_an_operation_or_for_its_middle(
    sit: Sit, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    run = _paused(sit, monkeypatch)
    dialog = _dialog(run)
    _choose(run.person, dialog, fault="The operation says that it failed",
            moment="While an operation runs", operation="Op_3c from bba")  # fmt: skip
    assert _line(dialog)["during"] == "SB1/State_bba/Op_3c"
    assert dialog.fact.isHidden()
    run.person.click(dialog.inject)
    _choose(run.person, dialog, fault="A fact is read wrongly", fact="Fact 1", value="a",
            moment="After an operation", operation="Op_2b from caa")  # fmt: skip
    assert _line(dialog)["when"] == "SB1/State_cba"
    run.person.click(dialog.inject)
    run.person.until(lambda: dialog.waiting.text() == "2 faults waiting for a moment")
    run.person.press(Key.Key_F5)
    run.until_phase("Fault hold")
    assert [event for event in run.events if isinstance(event, Disturbed)]
    run.person.until(lambda: dialog.waiting.text() == "1 fault waiting for a moment")
    _choose(run.person, dialog, fault="A fact is read rightly again", fact="Fact 1", moment="Now")
    assert dialog.value.isHidden()
    run.person.click(dialog.inject)
    run.person.until(lambda: "none" in dialog.said.text())
    dialog.close()
    run.person.press(Key.Key_F5)
    run.person.until(lambda: sum(isinstance(one, Held) for one in run.events) == 2)
    run.pane.run.adopt()
    run.person.until(lambda: any(isinstance(one, FaultInjected) for one in run.events))
    run.until_phase("Goal reached")
    ended = [e.as_json() for e in run.events if e.event == "operation_ended"]
    assert [one["address"] for one in ended if one["outcome"] == "failed"] == [
        "SB1/State_bba/Op_3c"
    ]
    _save(run, monkeypatch, tmp_path / "by-hand.jsonl")
    _same_again(run, tmp_path / "by-hand.jsonl")


def test_the_fault_of_a_script_file_and_of_the_dialog_are_the_same(
    sit: Sit, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    run = AtRun(sit(HANOI))
    run.choose("table")
    run.as_fast_as_it_goes()
    run.person.press(Key.Key_F10)
    run.until_done(1)
    dialog = _dialog(run)
    _choose(run.person, dialog, fault="The operation ends in another state",
            state="State_aba", moment="While an operation runs")  # fmt: skip
    assert dialog.operation.currentText() == "Op_2b from caa, next"
    line = _line(dialog)
    run.person.click(dialog.inject)
    dialog.close()
    run.person.press(Key.Key_F5)
    run.until_phase("Fault hold")
    steps = [{"do": "step"}, {"at": 0.05, "do": "resume"}]
    (tmp_path / "script.jsonl").write_text("\n".join(map(json.dumps, [*steps, line])))
    read = front.read(HANOI)
    again = front.run(read, script=read_script(tmp_path / "script.jsonl", read))
    ours = [e.line() for e in run.events if not isinstance(e, Commanded)]
    theirs = [e.line() for e in again.events if not isinstance(e, Commanded)]
    assert theirs[: len(ours)] == ours


def test_what_waits_can_be_taken_back(sit: Sit, monkeypatch: pytest.MonkeyPatch) -> None:
    run = _paused(sit, monkeypatch)
    dialog = _dialog(run)
    assert dialog.back.isHidden()
    _choose(run.person, dialog, moment="After an operation")
    run.person.click(dialog.inject)
    run.person.until(dialog.back.isVisible)
    run.person.click(dialog.back)
    run.person.until(lambda: not dialog.waiting.text())
    dialog.close()
    run.person.press(Key.Key_F5)
    run.until_phase("Goal reached")
    assert not [event for event in run.events if isinstance(event, FaultInjected)]


def test_without_a_run_the_dialog_says_so_and_offers_nothing(sit: Sit) -> None:
    run = AtRun(sit(HANOI))
    run.choose("table")
    actions = run.person.window.actions_table
    assert not actions["inject_fault"].isEnabled()
    assert not actions["save_script"].isEnabled()
    run.as_fast_as_it_goes()
    run.person.click(run.pane.transport.by_hand)
    run.person.press(Key.Key_F5)
    run.until_phase("Ready")
    dialog = _dialog(run)
    assert dialog.inject.isEnabled()
    run.person.press(Key.Key_F8)
    run.until_phase("Stopped")
    assert dialog.inject.isEnabled()
    run.pane.run.end()
    run.person.until(lambda: not run.pane.run.exists)
    assert not dialog.inject.isEnabled()
    assert dialog.refusal.text() == "A fault can be injected while a run is there"


def test_a_run_by_hand_is_saved_and_done_again(
    sit: Sit, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    run = AtRun(sit(HFSM))
    run.choose("table")
    run.as_fast_as_it_goes()
    run.person.click(run.pane.transport.by_hand)
    run.person.press(Key.Key_F5)
    run.until_phase("Ready")
    run.click_arrow("SB1/State000/Operation000")
    run.until_done(1)
    run.click_in_list("Operation100B")
    run.until_done(3)
    run.person.press(Key.Key_F8)
    run.until_phase("Stopped")
    run.pane.run.end()
    run.person.until(lambda: not run.pane.run.exists)
    assert run.pane.scene.script.text().strip() == "Script 5…"
    path = tmp_path / "by-hand"
    monkeypatch.setattr(dialogs, "ask_to_save", lambda *_: (str(path), ""))
    run.person.window.actions_table["save_script"].trigger()
    _same_again(run, path.with_suffix(".jsonl"), HFSM)
    first = json.loads(path.with_suffix(".jsonl").read_text().splitlines()[0])
    assert first["_run"].startswith("smsl-studio run hfsm.json --world table")


def _going(sit: Sit, monkeypatch: pytest.MonkeyPatch, path: Path = HANOI) -> AtRun:
    """A run in the middle of its first operation, which is shown for very long."""
    run = AtRun(sit(path))
    monkeypatch.setattr(operation_time, "USUAL", 1e6)
    run.choose("table")
    run.person.press(Key.Key_F5)
    run.until_runs()
    return run


def test_the_run_is_held_while_one_chooses_and_goes_on_afterwards(
    sit: Sit, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    run = _going(sit, monkeypatch)
    dialog = _dialog(run)
    run.until_phase("Paused")
    run.person.until(lambda: dialog.hold.words.text() == (
        "The run is held at 0.00 s while you choose. It goes on when you close this."))  # fmt: skip
    run.person.click(dialog.inject)
    run.person.until(lambda: dialog.said.text() == "Disturbed at 0.00 s: SB1/0 stuck.")
    assert run.phase == "Paused"
    monkeypatch.setattr(operation_time, "USUAL", 0.0)
    run.as_fast_as_it_goes()
    run.person.click(dialog.close_button)
    run.until_phase("Fault hold")
    _save(run, monkeypatch, tmp_path / "by-hand.jsonl")
    _same_again(run, tmp_path / "by-hand.jsonl")


def test_closed_at_once_the_run_goes_on_too(sit: Sit, monkeypatch: pytest.MonkeyPatch) -> None:
    run = _going(sit, monkeypatch)
    dialog = _dialog(run)
    run.person.press(Key.Key_Escape)
    run.person.until(lambda: not dialog.isVisible())
    run.person.until(
        lambda: (
            [(one.command, one.refused) for one in run.events if isinstance(one, Commanded)]
            == [("pause", ""), ("resume", "")]
        )
    )
    run.until_phase("Running")


def test_what_the_person_does_meanwhile_counts(sit: Sit, monkeypatch: pytest.MonkeyPatch) -> None:
    run = _going(sit, monkeypatch)
    dialog = _dialog(run)
    run.until_phase("Paused")
    run.person.click(dialog.hold.button)
    run.until_phase("Running")
    run.person.until(lambda: dialog.hold.words.text() == "The run goes on while you choose.")
    run.person.click(dialog.hold.button)
    run.until_phase("Paused")
    run.person.press(Key.Key_F8)
    run.until_phase("Stopped")
    assert dialog.hold.isHidden()
    run.person.click(dialog.close_button)
    run.person.until(lambda: not dialog.isVisible())
    run.pane.run.end()
    run.person.until(lambda: not run.pane.run.exists)
    assert [one.command for one in run.events if isinstance(one, Commanded)] == [
        "pause", "resume", "pause", "stop", "end"]  # fmt: skip


def test_a_run_that_was_paused_before_stays_paused(
    sit: Sit, monkeypatch: pytest.MonkeyPatch
) -> None:
    run = _paused(sit, monkeypatch)
    dialog = _dialog(run)
    assert dialog.hold.words.text() == "The run is paused at 0.00 s, and stays so."
    assert dialog.hold.button.isHidden()
    dialog.close()
    run.person.until(lambda: not dialog.isVisible())
    run.person.come_back()
    run.person.press(Key.Key_F8)
    run.until_phase("Stopped")
    assert "resume" not in [one.command for one in run.events if isinstance(one, Commanded)]


def test_the_window_closes_while_the_dialog_holds_its_run(
    sit: Sit, monkeypatch: pytest.MonkeyPatch
) -> None:
    run = _going(sit, monkeypatch)
    dialog = _dialog(run)
    run.until_phase("Paused")
    run.person.window.features.stop()
    assert not dialog.isVisible()
    assert not run.pane.run.exists
    assert "resume" not in [one.command for one in run.events if isinstance(one, Commanded)]


def test_what_is_offered_first_changes_something(sit: Sit, monkeypatch: pytest.MonkeyPatch) -> None:
    run = _paused(sit, monkeypatch)
    dialog = _dialog(run)
    assert dialog.fault.currentText() == "A fact is read wrongly"
    assert (dialog.fact.currentText(), dialog.value.currentText()) == ("Fact 1", "b")
    _choose(run.person, dialog, fault=SET)
    assert dialog.value.currentText() != "a"
    assert dialog.moment.currentText() == "After an operation", "Op_1c would take it back"
    assert dialog.operation.currentText() == "Op_1c from aaa, runs now"
    assert dialog.value.currentText() != "c", "Op_1c makes it c"
    _choose(run.person, dialog, fault="The operation ends in another state", moment="Now")
    assert dialog.state.currentText() != "State_caa"


def test_a_choice_without_effect_is_not_injected(sit: Sit, monkeypatch: pytest.MonkeyPatch) -> None:
    run = _paused(sit, monkeypatch)
    dialog = _dialog(run)
    right = "A fact is read rightly again"
    cases: list[tuple[dict[str, str], str]] = [
        ({"fault": right, "fact": "Fact 1", "moment": "Now"}, "Fact 1 is read rightly already."),
        ({"fault": SET, "fact": "Fact 1", "moment": "After an operation", "value": "c"},
         "Fact 1 is c then already: choose another value."),
        ({"fault": "The operation ends in another state", "state": "State_caa", "moment": "Now"},
         "Op_1c ends in caa anyway: choose another state."),
    ]  # fmt: skip
    for chosen, words in cases:
        _choose(run.person, dialog, **chosen)
        assert dialog.undone.text() == words
        run.person.click(dialog.inject)
        assert dialog.refusal.text() == words
    assert not run.pane.run.planned
    _choose(run.person, dialog, fault="A fact is read wrongly", fact="Fact 1", value="a")
    assert dialog.undone.text() == "Fact 1 is a then, so this shows only when it changes."
    run.person.click(dialog.inject)
    run.person.until(lambda: any(isinstance(one, Disturbed) for one in run.events))
    _choose(run.person, dialog, fault=right)
    assert not dialog.undone.text(), "now there is something to set right"
    assert not [one for one in run.events if isinstance(one, FaultInjected)]


def test_a_new_run_offers_its_next_operation_and_not_the_one_chosen_in_the_run_before(
    sit: Sit, monkeypatch: pytest.MonkeyPatch
) -> None:
    run = _paused(sit, monkeypatch)
    dialog, person = _dialog(run), run.person
    first = dialog.operation.itemText(0)
    dialog.operation.setCurrentIndex(2)
    assert dialog.operation.currentText() != first
    dialog.close()
    person.come_back()
    run.pane.run.finish()
    person.until(lambda: not run.pane.run.exists)
    monkeypatch.setattr(operation_time, "USUAL", 1e6)
    run.pane.play()
    run.until_runs()
    again = _dialog(run)
    assert again.operation.currentText() == first
