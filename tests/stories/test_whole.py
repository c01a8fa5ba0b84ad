"""During a run no text is cut at 1280 pixels; shortened text is complete in its tooltip."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QComboBox, QHeaderView, QLabel, QLineEdit, QWidget

from tests.stories.at_supervise import AtSupervise
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES
from tests.stories.test_window import check_named, check_whole

Key = Qt.Key
PARTS = QLineEdit | QComboBox | QHeaderView
SAMPLE = SAMPLES / "registration.json"


def _check(window: QWidget) -> None:
    window.repaint()
    seen = 0
    for widget in window.findChildren(QWidget):
        part_of_qt = isinstance(widget.parent(), PARTS) or widget.objectName().startswith("qt_")
        if widget.isVisible() and not part_of_qt:
            seen += 1
            check_named(widget)
            if not _tells_all(widget):
                check_whole(widget)
    assert seen > 50


def _tells_all(widget: QWidget) -> bool:
    """Whether the tooltip of a label has everything that it says."""
    return isinstance(widget, QLabel) and widget.text() in widget.toolTip()


@pytest.mark.parametrize("mode", ["supervise", "run"])
@pytest.mark.parametrize("phase", ["Paused", "Ready", "No route", "Taken over", "Stopped"])
def test_no_text_is_cut_in_any_state_of_a_run(sit: Sit, phase: str, mode: str) -> None:
    at = AtSupervise(sit(SAMPLE, (1280, 800)))
    _come_to(at, phase)
    at.until_phase(phase)
    at.person.window.set_mode(mode)
    at.person.until(lambda: at.person.window.size().width() == 1280)
    # What was said last is laid out in a moment.
    at.person.qtbot.waitUntil(lambda: _check(at.person.window), timeout=5000)


def _come_to(at: AtSupervise, phase: str) -> None:
    if phase == "Ready":
        at.person.ctrl(Key.Key_2)
        at.person.click(at.person.window.features.run.pane.transport.by_hand)
        at.person.ctrl(Key.Key_3)
        at.start("table")
        return
    at.start_paused()
    run = at.run
    if phase == "No route":
        assert run.status is not None
        for item in run.status.possible:
            run.prune(item.address, "the grip slipped here, as it did in the room before")
        run.resume()
    elif phase == "Taken over":
        run.take_over()
    elif phase == "Stopped":
        run.stop()
