"""The words on an empty drawing: what they ask for works on them too."""

from __future__ import annotations

from pathlib import Path

import pytest
from PySide6.QtCore import QPoint, QSize, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel

from smsl_studio.studio.shell.frame import screen_room
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


@pytest.mark.parametrize("size", [(1280, 720), (634, 336)])
def test_the_words_are_read_whole_and_lie_on_nothing(
    sit: Sit, size: tuple[int, int], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(screen_room, "SMALLEST", QSize(1, 1))
    person = sit(begin=False, size=(1440, 900))
    person.ctrl(Qt.Key.Key_N)
    person.window.resize(*size)
    person.until(lambda: (person.window.width(), person.window.height()) == size)
    canvas = person.window.canvas
    hint = canvas.overlays.empty
    (words,) = hint.findChildren(QLabel)
    person.until(lambda: canvas.rect().contains(hint.geometry()))
    person.until(lambda: hint.rect().contains(words.geometry()))
    wrap = int(Qt.TextFlag.TextWordWrap) if words.wordWrap() else 0
    needed = words.fontMetrics().boundingRect(words.contentsRect(), wrap, words.text())
    assert needed.width() <= words.width()
    assert needed.height() <= words.height()
    assert not words.geometry().intersects(hint.sample.geometry())
    lines = 1 if size[0] > 1000 else 2
    assert words.heightForWidth(words.width()) <= lines * words.fontMetrics().lineSpacing()
    floats = [one for one in canvas.overlays.floats() if one.intersects(hint.geometry())]
    assert floats == []
