"""Fixtures: a window, and a person at it."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path

import pytest
from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QAccessible, QAccessibleAnnouncementEvent, QAccessibleEvent
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from smsl_studio.host.plugin_offers import describe
from smsl_studio.library.loaded import Loaded
from smsl_studio.studio.base import announcement
from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.base.style import prepare
from smsl_studio.studio.base.theme import LIGHT
from smsl_studio.studio.running import operation_time
from smsl_studio.studio.shell import plugins
from smsl_studio.studio.shell.application import make_window
from smsl_studio.studio.shell.plugins import Plugins
from smsl_studio.studio.shell.window import Window
from smsl_studio.studio.shell.windows import Windows
from tests.stories.at_canvas import Drawer, sample
from tests.stories.person import Person

Sit = Callable[..., Person]
Heard = list[tuple[str, bool]]
"""What was read out by itself: the words, and whether they interrupt."""


class Look:
    """Looks for plugins: the first time as any story has found them, afterwards anew."""

    def __init__(self) -> None:
        self._before = False

    def __call__(self) -> Loaded:
        again, self._before = self._before, True
        return describe() if again else _looked(os.environ.get("SMSL_PLUGIN_PATH", ""))


@cache
def _looked(path: str) -> Loaded:
    return describe()


@pytest.fixture
def sit(
    qapp: QApplication, qtbot: QtBot, home: Path, monkeypatch: pytest.MonkeyPatch
) -> Iterator[Sit]:
    """Open a window on a copy of a file, else with a new drawing, and sit down at it.

    With ``begin`` False the window stays at the start page. Without physics operations are shown
    for a short time only, because nobody has to follow them. Plugins are looked for at once.
    """
    monkeypatch.setattr(operation_time, "USUAL", 0.02)
    monkeypatch.setattr(plugins, "SOON", 0)
    # As at a start of the program: the first window brings the style sheet.
    qapp.setStyleSheet("")
    prepare(qapp, LIGHT)
    made = [Windows(qapp, Settings(home), Plugins(Look()))]

    def open_on(
        path: Path | None = None, size: tuple[int, int] = (1440, 900), begin: bool = True
    ) -> Person:
        (windows,) = made
        windows.settings.theme = "light"
        window = make_window(windows, str(path) if path else "")
        qtbot.waitUntil(lambda: windows.plugins.known)
        window.resize(*size)
        window.activateWindow()
        qtbot.waitUntil(window.isActiveWindow)
        person = Person(window, qtbot, windows)
        if path is None and begin:
            person.ctrl(Qt.Key.Key_N)
        if begin:
            window.canvas.setFocus()
        return person

    yield open_on
    # The test holds ``open_on`` for longer. So that holds no window any more.
    _close_all(made.pop())
    # Closed windows are kept until the event loop runs. It runs here, so that they are freed with
    # this test and not within the next one.
    qapp.processEvents()
    qapp.sendPostedEvents(None, QEvent.Type.DeferredDelete)


def _close_all(windows: Windows) -> None:
    for window in windows:
        assert isinstance(window, Window)
        window.settle()
        window.session.history.setClean()
        # A form in which a story has left something would ask.
        window.files.take_over = lambda: ""
        pane = window.features.run.part.made
        if pane is not None:
            pane.run.close()
        window.close()


def reader(hear: Callable[[QAccessibleEvent], object]) -> type[QAccessible]:
    """A screen reader that runs, in the place of ``QAccessible``; ``hear`` gets what it is told."""

    class Reader(QAccessible):
        """The reader."""

        @staticmethod
        def isActive() -> bool:
            return True

        @staticmethod
        def updateAccessibility(event: QAccessibleEvent, /) -> None:
            hear(event)

    return Reader


@pytest.fixture
def heard(monkeypatch: pytest.MonkeyPatch) -> Heard:
    """Every announcement, and whether it interrupts."""
    found: Heard = []

    def hear(event: QAccessibleEvent) -> None:
        """Keep an announcement."""
        if isinstance(event, QAccessibleAnnouncementEvent):
            urgent = event.politeness() == QAccessible.AnnouncementPoliteness.Assertive
            found.append((event.message(), urgent))

    monkeypatch.setattr(announcement, "QAccessible", reader(hear))
    return found


@pytest.fixture
def hfsm(qtbot: QtBot) -> Drawer:
    """A canvas on the paper's small hierarchy."""
    return Drawer(qtbot, sample("hfsm.json"))


@pytest.fixture
def hanoi(qtbot: QtBot) -> Drawer:
    """A canvas on the corrected Tower of Hanoi."""
    return Drawer(qtbot, sample("hanoi-corrected.json"))
