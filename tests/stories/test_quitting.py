"""Ctrl+Q with several windows: every question is asked before anything is closed."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pytest
from PySide6.QtCore import Qt, QTimer
from PySide6.QtWidgets import QApplication, QMessageBox

from smsl_studio.blueprint import editing
from smsl_studio.studio.document.files import dialogs
from smsl_studio.studio.shell.window import Window
from tests.stories.conftest import Sit
from tests.stories.person import Person
from tests.stories.test_closing import by_hand
from tests.stories.test_files import copy_of

Key = Qt.Key


def draw(person: Person, name: str) -> None:
    """An unsaved state, which the journal holds."""
    window = person.window
    window.session.edit(
        f"Add {name}", lambda bp: editing.add_state(bp, window.session.branch, name)
    )
    assert window.safety.journal.flush()


def quit_and_answer(person: Person, *answers: str) -> list[str]:
    """Press Ctrl+Q and answer one question after the other; what was asked, and of which window."""
    person.come_back()
    asked: list[str] = []

    def answer(left: Sequence[str]) -> None:
        box = QApplication.activeModalWidget()
        if not isinstance(box, QMessageBox):
            QTimer.singleShot(10, lambda: answer(left))
            return
        asked.append(box.text())
        window = box.parentWidget()
        assert isinstance(window, Window)
        shown = box.text().split(" ")[0]
        assert shown in window.windowTitle() or "run of" in box.text()
        if left[1:]:
            QTimer.singleShot(0, lambda: answer(left[1:]))
        next(b for b in box.buttons() if b.text().replace("&", "") == left[0]).click()

    QTimer.singleShot(0, lambda: answer(answers))
    person.ctrl(Key.Key_Q)
    return asked


def stands(person: Person, state: str) -> bool:
    """Whether a window is there with its work, and its journal with it."""
    window = person.window
    path = window.safety.journal.path
    return (
        window.isVisible()
        and state in window.session.blueprint[window.session.branch].table
        and window.session.edited
        and path is not None
        and path.exists()
    )


@pytest.mark.parametrize("first_answer", ["Discard changes", "Save"])
def test_cancel_at_the_last_question_leaves_every_window_as_it_was(
    sit: Sit, tmp_path: Path, first_answer: str
) -> None:
    path = copy_of("hfsm.json", tmp_path)
    text = path.read_text()
    first, second = sit(path), sit()
    draw(first, "State_new")
    draw(second, "State_0")
    asked = quit_and_answer(second, first_answer, "Cancel")
    assert asked == [
        f"hfsm.json has unsaved changes. hfsm.json is in {tmp_path}.",
        "untitled.json has unsaved changes. untitled.json was never saved. It has 1 state; "
        "the last step is “Add State_0”.",
    ]
    assert stands(first, "State_new")
    assert stands(second, "State_0")
    assert path.read_text() == text, "nothing is saved before everything is answered"
    assert set(first.windows) == {first.window, second.window}
    asked = quit_and_answer(second, first_answer, "Discard changes")
    assert len(asked) == 2
    assert list(first.windows) == []
    assert (path.read_text() != text) == (first_answer == "Save")
    assert first.window.safety.journal.path is None or not first.window.safety.journal.path.exists()


def test_two_untitled_windows_are_told_apart(sit: Sit) -> None:
    first, second = sit(), sit()
    draw(first, "State_0")
    draw(second, "State_1")
    asked = quit_and_answer(second, "Discard changes", "Cancel")
    assert len(set(asked)) == 2
    assert stands(first, "State_0")
    assert stands(second, "State_1")


def test_a_run_of_another_window_goes_on_when_quitting_is_called_off(
    sit: Sit, tmp_path: Path
) -> None:
    run = by_hand(sit, copy_of("hfsm.json", tmp_path))
    second = sit()
    draw(second, "State_0")
    asked = quit_and_answer(second, "Stop and close", "Cancel")
    assert len(asked) == 2
    assert run.pane.run.exists
    assert run.phase == "Ready"
    assert stands(second, "State_0")


def test_a_save_that_is_called_off_closes_nothing(
    sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first, second = sit(copy_of("hfsm.json", tmp_path)), sit()
    draw(first, "State_new")
    draw(second, "State_0")
    monkeypatch.setattr(dialogs, "ask_to_save", lambda *_: ("", ""))
    quit_and_answer(second, "Discard changes", "Save")
    assert stands(first, "State_new")
    assert stands(second, "State_0")
