"""The keys of a run work for any keyboard focus: in every part of every mode, and in dialogs."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from PySide6.QtCore import QObject, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QWidget

import smsl_studio as smsl
from smsl_studio.studio.features.replay.watched import Watched
from smsl_studio.studio.shell.windows import Windows
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key = Qt.Key
KEYS = {Key.Key_F5: "play", Key.Key_F6: "pause", Key.Key_F10: "step", Key.Key_F8: "stop"}


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """What the keys have asked of the run; nothing comes of it."""
    heard: list[str] = []

    def tell(name: str) -> Callable[[QObject], None]:
        return lambda _: heard.append(name)

    for name in ("play", "pause", "step"):
        monkeypatch.setattr(Watched, name, tell(name))
    monkeypatch.setattr(Windows, "stop_every_run", tell("stop"))
    return heard


def focusable(window: QWidget) -> list[QWidget]:
    """All that a click or Tab may give the keys to."""
    return [
        part
        for part in window.findChildren(QWidget)
        if part.isVisible()
        and part.isEnabled()
        and part.window() is window
        and part.focusPolicy() != Qt.FocusPolicy.NoFocus
    ]


def named(part: QWidget) -> str:
    return f"{type(part).__name__} {part.accessibleName() or part.objectName()!r}"


def deaf(person: Person, window: QWidget, asked: list[str]) -> set[str]:
    """The parts of a window in which one of the keys is dead, or does something else."""
    window.activateWindow()
    person.qtbot.waitUntil(window.isActiveWindow)
    found: set[str] = set()
    parts = focusable(window)
    assert parts
    # The keys would show the run; here the mode stays as it is.
    person.window.set_mode = lambda mode: None  # type: ignore[method-assign]
    for part in parts:
        for key, what in KEYS.items():
            part.setFocus()
            focus = QApplication.focusWidget()
            assert focus is not None
            asked.clear()
            QTest.keyClick(focus, key)
            if asked != [what]:
                found.add(f"{named(part)}: {what} {asked}")
    del person.window.set_mode
    return found


def test_in_every_part_of_draw(sit: Sit, asked: list[str]) -> None:
    person = sit(SAMPLES / "hanoi.json")
    person.until_inspected()
    for selected in ("SB1/State_aaa", "SB1/State_aaa/Op_1b"):
        person.select(selected)
        assert deaf(person, person.window, asked) == set()
    for panel in person.window.docks.panels:
        person.window.show_tab(panel.name)
        assert deaf(person, person.window, asked) == set()


@pytest.mark.parametrize("mode", ["run", "supervise"])
def test_in_every_part_of_a_run(sit: Sit, asked: list[str], mode: str) -> None:
    person = sit(SAMPLES / "hanoi.json")
    person.window.set_mode(mode)
    assert deaf(person, person.window, asked) == set()


def test_in_every_part_of_a_replay(sit: Sit, asked: list[str], tmp_path: Path) -> None:
    log = tmp_path / "run.jsonl"
    smsl.run(smsl.read(SAMPLES / "hfsm.json"), log=log)
    person = sit(log)
    person.until(lambda: person.window.mode == "replay")
    assert deaf(person, person.window, asked) == set()


def test_in_the_windows_beside_it(sit: Sit, asked: list[str], tmp_path: Path) -> None:
    path = tmp_path / "hanoi.json"
    path.write_bytes((SAMPLES / "hanoi.json").read_bytes())
    person = sit(path)
    person.window.set_mode("supervise")
    person.ctrl(Key.Key_M)
    page = person.window.features.monitor.opener.window
    assert page is not None
    person.until(page.isVisible)
    assert deaf(person, page, asked) == set()
    page.close()
    person.come_back()
    person.window.set_mode("draw")
    person.window.actions_table["compare_saved"].trigger()
    compare = person.window.comparing.dialog
    assert compare is not None
    person.qtbot.waitExposed(compare)
    assert deaf(person, compare, asked) == set()
    compare.close()
    person.come_back()


def test_the_palette_lets_the_keys_of_the_run_through(sit: Sit, asked: list[str]) -> None:
    person = sit(SAMPLES / "hanoi.json")
    for key, what in KEYS.items():
        person.ctrl(Key.Key_K)
        asked.clear()
        person.press(key)
        assert asked == [what]
        person.window.command_palette.close_palette()
        person.window.set_mode("draw")
        person.window.canvas.setFocus()
