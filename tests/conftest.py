"""The setup of every test: no display, its own home folder, equal random examples each time."""

from __future__ import annotations

import gc
import itertools
import logging
import os
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings
from PySide6.QtGui import QCursor, QGuiApplication
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from smsl_studio.studio.document import afterwards
from tests.counts import share_of

# Before anything imports Qt. The screen has a usual size: on that of Qt, which has 800 x 800, every
# window would begin narrow and be laid out again.
SCREEN = Path(__file__).with_name("screen.json")
os.environ["QT_QPA_PLATFORM"] = f"offscreen:configfile={SCREEN}"

# Plugins are loaded from folders only that others may not write, whoever runs the tests.
os.umask(0o022)

settings.register_profile(
    "house",
    max_examples=share_of(100),
    derandomize=True,
    deadline=None,
    database=None,
    suppress_health_check=[HealthCheck.too_slow],
)
settings.load_profile("house")


def pytest_collection() -> None:
    """Switch Python's collector off while the tests are found, because they all stay."""
    gc.disable()


def pytest_collection_finish() -> None:
    """Keep the collector away from the tests, which are half a million objects.

    A collection of all objects would take 0.3 s, and the window makes one again and again.
    """
    gc.freeze()
    gc.enable()


@pytest.fixture(scope="session")
def _homes(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    base = tmp_path_factory.mktemp("homes")
    return (base / str(number) for number in itertools.count())


@pytest.fixture(autouse=True)
def home(_homes: Iterator[Path], monkeypatch: pytest.MonkeyPatch) -> Path:
    """The user's folder of this test; nobody's real settings or plugins are read or written."""
    folder = next(_homes)
    monkeypatch.setenv("SMSL_STUDIO_HOME", str(folder))
    monkeypatch.delenv("SMSL_PLUGIN_PATH", raising=False)
    return folder


@pytest.fixture
def sets_nothing_aside(monkeypatch: pytest.MonkeyPatch) -> None:
    """The window sets no objects aside (freezes none) and brings none back.

    What is set aside are all tests, a million objects. To count them takes 30 ms, and a collection
    of them half a second. Whoever brings them back puts them aside again at the end.
    """
    monkeypatch.setattr(gc, "freeze", lambda: None)
    monkeypatch.setattr(gc, "unfreeze", lambda: None)


@pytest.fixture(autouse=True)
def _garbage_of_windows(request: pytest.FixtureRequest) -> Iterator[None]:
    """What a test of windows leaves is collected in this thread, not in a worker thread of it.

    Qt crashes if a widget is freed in another thread. Else timers of a window would also run on in
    later tests, and be freed in the middle of one.
    """
    if "qapp" not in request.fixturenames:
        yield
        return
    request.getfixturevalue("sets_nothing_aside")
    gc.disable()
    yield
    gc.collect()
    gc.enable()


class PatientBot(QtBot):
    """Waits until something is so; a busy machine takes as long as it takes."""

    def waitUntil(self, callback: Callable[[], bool | None], *, timeout: int = 60_000) -> None:
        super().waitUntil(callback, timeout=timeout)


@pytest.fixture
def qtbot(qapp: QApplication, request: pytest.FixtureRequest) -> QtBot:
    return PatientBot(request)


@pytest.fixture(autouse=True)
def _all_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Forms and lists follow an edit at once, because tests read them and press no key before.

    ``tests/stories/test_afterwards.py`` and the random sequences have the real moment.
    """
    monkeypatch.setattr(afterwards, "MOMENT", 0)


@pytest.fixture(autouse=True)
def _pointer_elsewhere() -> None:
    """The pointer points at nothing, wherever the test before left it.

    A window that opens below it would show what lies there as pointed at, some time later.
    """
    if QGuiApplication.instance() is not None:
        QCursor.setPos(-10_000, -10_000)


@pytest.fixture(autouse=True)
def _no_stray_records(caplog: pytest.LogCaptureFixture) -> Iterator[None]:
    """A record of level WARNING or above fails the test that let it out.

    A test that expects one reads it from ``caplog`` and then calls ``caplog.clear()``.
    """
    yield
    stray = [
        record
        for phase in ("setup", "call")
        for record in caplog.get_records(phase)
        if record.levelno >= logging.WARNING
    ]
    assert not stray, [f"{record.name}: {record.getMessage()}" for record in stray]
