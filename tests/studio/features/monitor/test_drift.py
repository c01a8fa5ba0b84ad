"""The forecasts of a run against what came, in the monitor."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtWidgets import QVBoxLayout, QWidget
from pytestqt.qtbot import QtBot

from smsl_studio import front
from smsl_studio.front.inputs import read
from smsl_studio.runlog.events import ForecastTold, RunStarted
from smsl_studio.shipped import samples_dir
from smsl_studio.studio.base.theme import LIGHT
from smsl_studio.studio.features.monitor.drift import DriftPanel
from smsl_studio.studio.running.run_session import RunSession

SAMPLE = read(samples_dir() / "hanoi-2.json")


def test_the_forecasts_of_a_run_are_counted_and_those_of_recordings_can_be_read(
    qtbot: QtBot, tmp_path: Path
) -> None:
    page, run = QWidget(), RunSession()
    panel = DriftPanel(run, LIGHT)
    QVBoxLayout(page).addWidget(panel)
    qtbot.addWidget(page)
    page.show()
    panel.set_tokens(LIGHT)
    panel.refresh()
    assert not panel.isVisible()
    events = front.run(SAMPLE, forecast="show", log=tmp_path / "run.jsonl").events
    run.events_told.emit(events)
    wrong = ForecastTold(t=9.0, address="SB1/State_aa/Op_1b", verdict="wrong", reason="SB1/0 is c")
    run.events_told.emit((wrong,))
    panel.refresh()
    assert panel.isVisible()
    assert panel.words.text() == "The world simulator was right in 3 of 4"
    assert [row.right for row in panel.rows.rows.rows] == ["1 of 2", "1 of 1", "1 of 1"]
    assert panel.rows.rows.rows[0].tip == "SB1/0 is c"
    run.recordings = tmp_path
    panel.other.click()
    qtbot.waitUntil(lambda: panel.other.text() == "This run")
    assert panel.words.text() == "The world simulator was right in 3 of 3"
    panel.other.click()
    assert panel.words.text() == "The world simulator was right in 3 of 4"
    run.events_told.emit(tuple(e for e in events if isinstance(e, RunStarted)))
    panel.refresh()
    assert not panel.isVisible(), "another run begins with none"
