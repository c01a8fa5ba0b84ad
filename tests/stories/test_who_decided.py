"""When a run has ended, Supervise tells who decided what."""

from __future__ import annotations

from PySide6.QtCore import Qt

from tests.stories.at_supervise import AtSupervise
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES


def test_the_end_of_a_run_tells_who_decided_what(sit: Sit) -> None:
    at = AtSupervise(sit(SAMPLES / "hanoi-2.json", (1280, 800)))
    assert at.pane.notice.decided == ""
    at.start_paused()
    at.press(Qt.Key.Key_F5)
    at.person.qtbot.waitUntil(lambda: at.run.over)
    assert at.pane.notice.decided == "a person: 1 step, 1 resume"
    at.start_paused()
    at.press(Qt.Key.Key_V, Qt.Key.Key_Return, Qt.Key.Key_F5)
    at.person.qtbot.waitUntil(lambda: at.run.over)
    assert "1 step, 1 veto, 1 resume" in at.pane.notice.decided
