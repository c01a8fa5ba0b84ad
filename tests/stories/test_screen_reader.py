"""A person who cannot see the window: a real window, a real bus, a real screen reader.

The window runs as a child on a virtual display, and Debian's ``pyatspi`` walks its tree. ``./dev``
installs what that needs.
"""

from __future__ import annotations

import json
import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from smsl_studio.shipped import samples_dir
from tests.stories.conftest import Sit
from tests.stories.screen_reader.busy_window import Busy
from tests.stories.screen_reader.reading import nameless, session, virtual_screen

ROUND = 38
"""So many acts make a round of the person who is busy."""


@pytest.fixture
def display() -> Iterator[str]:
    """A virtual screen of its own."""
    with virtual_screen() as name:
        yield name


def test_a_screen_reader_finds_every_state_operation_and_control(
    display: str, home: Path, tmp_path: Path
) -> None:
    file = Path(shutil.copy(samples_dir() / "hanoi-2.json", tmp_path))
    blueprint = json.loads(file.read_text())["SB1"]
    states = {name: list(edges) for name, edges in blueprint.items() if name != "HEADER"}
    done, things = session(file, display, home, walks=3)
    assert done.returncode == 0, done.stderr[-2000:]

    on_canvas = [(role, name, path) for role, name, path, _ in things if "Canvas" in path]
    first_words = [(name.split(",")[0], path[-1].split(",")[0]) for _, name, path in on_canvas]
    for state, operations in states.items():
        assert (state, "Canvas") in first_words
        for operation in operations:
            assert (operation, state) in first_words
    assert not nameless(things)


def test_the_person_in_the_window_that_is_walked_through_is_busy(
    sit: Sit, tmp_path: Path, qtbot: QtBot
) -> None:
    """A bench walks while somebody draws and runs, so each of these acts must be possible."""
    told = tmp_path / "acts"
    busy = Busy(sit(samples_dir() / "hfsm.json").window, told)
    qtbot.waitUntil(told.exists)
    busy.stop()
    for _ in range(ROUND):
        busy.act()
        QApplication.processEvents()
    assert int(told.read_text()) > ROUND
