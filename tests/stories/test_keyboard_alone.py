"""A person without a pointer draws, checks, runs, supervises, stops and saves a procedure.

The same keys are pressed in this process, and in a window that a screen reader reads.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.runlog.events import Event
from smsl_studio.smsl.files import read_document
from smsl_studio.studio.document.files.dialogs import Dialogs
from tests.stories.conftest import Sit
from tests.stories.person import Person
from tests.stories.screen_reader import steps
from tests.stories.screen_reader.reading import virtual_screen

HERE = Path(__file__).parent / "screen_reader"
Key = Qt.Key


def take(person: Person, *group: steps.Step) -> None:
    """Press the keys of steps on whatever has them, and type their texts."""
    for step in group:
        keys = QKeySequence(step.key)[0]  # type: ignore[index]
        target = QApplication.activePopupWidget() or person._focus()
        QTest.keyClick(target, keys.key(), keys.keyboardModifiers())
        QApplication.processEvents()
        if QApplication.activePopupWidget() is None and QApplication.focusWidget() is None:
            person.come_back()
        if step.text:
            person.type(step.text)


def tables(path: Path) -> dict[str, dict[str, dict[str, str]]]:
    """The tables of a saved file."""
    blueprint = read_blueprint(read_document(path))
    return {sb.name: {state: dict(out) for state, out in sb.table.items()} for sb in blueprint}


def test_a_procedure_is_drawn_run_and_saved_without_a_pointer(
    sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    person = sit()
    for group in (steps.FACTS, steps.STATES, steps.BACK, steps.SUB):
        take(person, *group)
    drawn = {sb.name: {s: dict(out) for s, out in sb.table.items()} for sb in person.blueprint}
    assert drawn == steps.DRAWN
    assert person.blueprint["SB1"].subs == {1: "SB2"}

    take(person, *steps.CHECK)
    person.until_inspected()
    assert person.window.findings.findings

    run = person.window.features.run.pane.run
    events: list[Event] = []
    run.events_told.connect(events.extend)
    take(person, *steps.RUN)
    person.until(lambda: run.phase == "paused")
    assert run.status is not None
    assert run.status.operations == 1

    # Veto the second operation out of the state; the run stays where it was.
    take(person, *steps.SUPERVISE)
    person.until(lambda: any("veto" in str(e) and "unclamp" in str(e) for e in events))
    assert run.phase == "paused"

    take(person, *steps.STOP)
    person.until(lambda: run.phase == "stopped")

    target = tmp_path / "drawn.json"
    monkeypatch.setattr(Dialogs, "file_to_save", lambda *_: target)
    take(person, *steps.LETTER, steps.Step("Esc"), steps.Step("Esc"), *steps.SAVE)
    assert not person.window.session.edited
    assert tables(target) == steps.DRAWN


@pytest.fixture
def display() -> Iterator[str]:
    """A virtual screen of its own."""
    with virtual_screen() as name:
        yield name


def test_a_screen_reader_reads_every_step_of_it(display: str, home: Path, tmp_path: Path) -> None:
    target = tmp_path / "drawn.json"
    environment = {
        **os.environ,
        "DISPLAY": display,
        "QT_QPA_PLATFORM": "xcb",
        "QT_LINUX_ACCESSIBILITY_ALWAYS_ON": "1",
        "SMSL_STUDIO_HOME": str(home),
        "PYTHONPATH": str(Path(__file__).parents[2]),
    }
    words = ("dbus-run-session", "--", "sh", HERE / "by_keys.sh", sys.executable, target)
    done = subprocess.run(
        [*map(str, words)], check=False, env=environment, capture_output=True, text=True,
        timeout=400, cwd=Path(__file__).parents[2],
    )  # fmt: skip
    assert done.returncode == 0, f"{done.stdout[-3000:]}\n{done.stderr[-3000:]}"
    assert tables(target) == steps.DRAWN
    told = json.loads(done.stdout.splitlines()[-1])
    # The first finding led into the sub-SB.
    assert told["states"] == list(steps.DRAWN["SB2"])
    assert told["run"] == "The run: Stopped"
    assert told["menu"] == ["Menu of home"]
    assert len(told["focused"]) == 1, told["focused"]
    assert "Initial state: Default (Off0)" in told["combos"]
