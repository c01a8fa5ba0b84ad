"""The plot below the facts of a recorded run."""

from __future__ import annotations

from types import SimpleNamespace
from typing import cast

from PySide6.QtWidgets import QApplication

from smsl_studio.runlog.events import FactChanged, Measured
from smsl_studio.runlog.playback import RunObserver
from smsl_studio.studio.base.theme import DARK, LIGHT
from smsl_studio.studio.features.replay.recorded_plot import RecordedPlot
from smsl_studio.studio.features.replay.replay import Replay
from tests.plugin_folder import blueprint_of

MADE = blueprint_of({
    "SB": {
        "_facts": {"0": {"name": "Held", "sources": {"force": "N"},
                         "predicate": {"0": "force < 1 N", "1": "force > 2 N"}}},
        "State_00": {"Close": "State_10"},
        "State_10": {},
    }
})  # fmt: skip


def measured(t: float, value: str) -> Measured:
    return Measured(t=t, branch="SB", digit=0, source="force", value=value, quality="good", taken=t)


def changed(t: float, value: str) -> FactChanged:
    return FactChanged(t=t, branch="SB", digit=0, value=value)


def test_a_chosen_fact_is_plotted_at_the_moment_that_is_shown(qapp: QApplication) -> None:
    told = RunObserver()
    told.tell([measured(1.0, "0.5"), changed(1.0, "0"), measured(5.0, "2.5"), changed(5.0, "1")])
    replay = SimpleNamespace(blueprint=MADE, story=told.story, time=1.5)
    part = RecordedPlot(cast("Replay", replay), LIGHT)
    assert part.isHidden()
    assert part.plot is None, "its library is loaded when a fact is chosen"
    part.choose(("SB", 0))
    assert not part.isHidden()
    assert part.plot is not None
    assert part.name.text() == "Held"
    assert part.plot.newest.text() == "now 0.5 N"
    assert list(part.plot.thresholds) == [1.0, 2.0]
    replay.time = 5.5
    part.refresh()
    assert part.plot.newest.text() == "now 2.5 N"
    part.set_tokens(DARK)
    part.choose(("SB", 1))
    assert part.plot.isHidden()
    assert not part.nothing.isHidden()
    part.close_button.click()
    assert part.isHidden()
