"""The plot of measures with its thresholds, and the notation below it."""

from __future__ import annotations

from PySide6.QtWidgets import QApplication

from smsl_studio.front.views.measure_traces import MeasureTrace, ThresholdLine
from smsl_studio.studio.base.theme import DARK, LIGHT
from smsl_studio.studio.features.monitor.measure_plot import MeasurePlot

FORCE = MeasureTrace("force", "N", (1.0, 2.0), ((0.5, 2.5),), (ThresholdLine(2.0, "1 if > 2 N"),))
TIP = MeasureTrace("tip <b>", "m", (1.0,), ((0.1,), (0.2,), (0.3,)), ())


def test_a_source_is_plotted_with_its_thresholds(qapp: QApplication) -> None:
    plot = MeasurePlot(LIGHT)
    assert plot.isHidden()
    plot.show_fact(("SB", 0), (FORCE, TIP), 10.0, ("f_1 = λs. F(sense(force, s))",))
    assert not plot.isHidden()
    assert plot.shown == FORCE
    assert list(plot.thresholds) == [2.0]
    assert plot.newest.text() == "now 2.5 N"
    assert plot.notation.text() == "f_1 = λs. F(sense(force, s))"
    plot.choose("tip <b>")
    assert plot.shown == TIP
    assert list(plot.thresholds) == []
    plot.set_tokens(DARK)
    assert plot.shown == TIP


def test_another_fact_begins_with_its_first_source_and_none_hides_it(qapp: QApplication) -> None:
    plot = MeasurePlot(LIGHT)
    plot.show_fact(("SB", 0), (FORCE, TIP), 10.0)
    plot.choose("tip <b>")
    plot.show_fact(("SB", 0), (FORCE, TIP), 11.0)
    assert plot.shown == TIP
    plot.show_fact(("SB", 1), (FORCE, TIP), 11.0)
    assert plot.shown == FORCE
    plot.show_fact(None, (), 11.0)
    assert plot.isHidden()
    assert plot.shown is None
