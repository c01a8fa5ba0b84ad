"""The words on an empty drawing: what they ask for works on them too."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest

from tests.stories.conftest import Sit


def test_the_first_state_is_added_by_keys_alone(sit: Sit) -> None:
    person = sit(begin=False)
    person.ctrl(Qt.Key.Key_N)
    assert person.window.canvas.hasFocus(), "a new drawing takes the keys"
    assert "Enter" in person.window.canvas.accessibleDescription()
    person.press(Qt.Key.Key_Return)
    person.type("Ready")
    person.press(Qt.Key.Key_Return)
    assert list(person.blueprint["SB1"].table) == ["Ready"]
    person.ctrl(Qt.Key.Key_Z)
    person.window.canvas.setFocus()
    person.press(Qt.Key.Key_Slash)
    person.type("Idle")
    person.press(Qt.Key.Key_Return)
    assert list(person.blueprint["SB1"].table) == ["Idle"]


def test_a_double_click_on_the_words_makes_a_state_there(sit: Sit, tmp_path: Path) -> None:
    file = tmp_path / "empty.json"
    file.write_text('{"SB1": {}}')
    person = sit(file)
    canvas = person.window.canvas
    hint = canvas.overlays.empty
    assert hint.isVisible()
    at = QPoint(hint.width() // 2, 20)
    assert canvas.childAt(hint.mapTo(canvas, at)) in (hint, canvas.viewport())
    place = canvas.mapToScene(canvas.viewport().mapFrom(canvas, hint.mapTo(canvas, at)))
    QTest.mouseDClick(hint, Qt.MouseButton.LeftButton, pos=at)
    person.type("Ready")
    person.press(Qt.Key.Key_Return)
    person.until(lambda: len(person.blueprint["SB1"].table) == 1)
    ((x, y),) = canvas.positions.values()
    assert abs(x - place.x()) < 17
    assert abs(y - place.y()) < 17
    assert not hint.isVisible()
