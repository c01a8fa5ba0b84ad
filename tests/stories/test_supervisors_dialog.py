"""Automatic supervisors of a run in the window, chosen in a dialog of the Run menu."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from smsl_studio.runlog.events import Commanded, Committed, Event, ForecastTold, RiskEstimated
from smsl_studio.studio.features.run.supervisors_dialog import SupervisorsDialog
from tests.stories.at_run import AtRun
from tests.stories.conftest import Sit
from tests.stories.person import Person

Key = Qt.Key
WAYS = {
    "SB": {
        "HEADER": {"INITIAL": "State_a", "ACTIVATING": "State_c", "NUM_FACTS": 1},
        "_operations": {
            "Near": {"risk": "high"},
            "Far": {"risk": "low", "cost": 5},
            "On": {"risk": "low"},
        },
        "State_a": {"Near": "State_c", "Far": "State_b"},
        "State_b": {"On": "State_c"},
        "State_c": {},
    }
}
"""Two ways from a to c: a short one of high risk, and a long one of low risk."""


def in_dialog(person: Person, act: Callable[[SupervisorsDialog], None]) -> None:
    """Choose the row of the Run menu, and do something in the dialog that opens."""
    person.window.actions_table["supervisors"].trigger()
    dialog = QApplication.activeModalWidget()
    assert isinstance(dialog, SupervisorsDialog)
    act(dialog)
    person.come_back()
    person.window.canvas.setFocus()


def started(sit: Sit, folder: Path) -> tuple[AtRun, list[Event]]:
    path = folder / "ways.json"
    path.write_text(json.dumps(WAYS), "utf-8")
    run = AtRun(sit(path))
    told: list[Event] = []
    run.choose("table")
    run.person.window.features.run.pane.run.events_told.connect(told.extend)
    return run, told


def test_a_supervisor_of_the_dialog_sends_the_run_the_longer_way(sit: Sit, tmp_path: Path) -> None:
    run, told = started(sit, tmp_path)
    person = run.person

    def choose(dialog: SupervisorsDialog) -> None:
        QTest.keyClicks(dialog.names, "limit:risk=0.5")
        assert "forecast: differs, missing" in "".join(
            one.text() for one in dialog.findChildren(type(dialog.refusal))
        )
        QTest.keyClick(dialog.forecast, Key.Key_End)
        assert dialog.forecast.currentText() == "The run holds where it differs"
        person.click(dialog.use)

    in_dialog(person, choose)
    person.press(Key.Key_F5)
    person.qtbot.waitUntil(lambda: run.pane.run.over, timeout=30_000)
    committed = [name for e in told if isinstance(e, Committed) for name in e.operations]
    assert committed == ["SB/State_a/Far", "SB/State_b/On"]
    assert [e.by for e in told if isinstance(e, Commanded)] == ["limit:risk=0.5"]
    assert any(isinstance(e, RiskEstimated) for e in told)
    assert [e.verdict for e in told if isinstance(e, ForecastTold)][-2:] == ["agrees", "right"]
    in_dialog(person, lambda dialog: _is_kept(dialog, person))


def _is_kept(dialog: SupervisorsDialog, person: Person) -> None:
    assert dialog.names.toPlainText() == "limit:risk=0.5"
    assert dialog.forecast.currentData() == "hold"
    person.click(dialog.cancel)


def test_what_is_no_supervisor_is_said_before_the_run(sit: Sit, tmp_path: Path) -> None:
    run, _ = started(sit, tmp_path)
    person = run.person

    def choose(dialog: SupervisorsDialog) -> None:
        for words, said in (
            ("limits", "There is no supervisor limits. Did you mean limit?"),
            ("limit:risk", "The option 'risk' of limit has no name and value"),
        ):
            dialog.names.clear()
            QTest.keyClicks(dialog.names, words)
            assert dialog.refusal.text().startswith(said), dialog.refusal.text()
            assert not dialog.use.isEnabled()
        person.click(dialog.cancel)

    in_dialog(person, choose)
    assert run.pane.next.supervisors.agents == ()
