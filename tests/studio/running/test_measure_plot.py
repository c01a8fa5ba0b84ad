"""The plot of measures with its thresholds, and the notation below it."""

from __future__ import annotations

from math import nan

from PySide6.QtWidgets import QApplication

from smsl_studio.front.views.measure_traces import MeasuredFact, MeasureTrace, ThresholdLine
from smsl_studio.studio.base.theme import DARK, LIGHT
from smsl_studio.studio.running.measure_plot import MeasurePlot

FORCE = MeasureTrace("force", "N", (1.0, 2.0), ((0.5, 2.5),), (ThresholdLine(2.0, "1 if > 2 N"),))
MISSING = MeasureTrace("gap", "mm", (1.0, 2.0, 3.0), ((nan, nan, 2.0),), (), "no reading")
NEVER = MeasureTrace("tag", "m", (), ((),), ())
TIP = MeasureTrace("tip <b>", "m", (1.0,), ((0.1,), (0.2,), (0.3,)), ())
NOTATION = ("f_1 = λs. F(sense(force, s))",)
VALUES = ((4.0, 8.0, "0"), (8.0, 10.0, "?"))


def fact(digit: int, now: float) -> MeasuredFact:
    return MeasuredFact(("SB", digit), "Held", now, (FORCE, TIP), VALUES, NOTATION)


def test_a_source_is_plotted_with_its_thresholds(qapp: QApplication) -> None:
    plot = MeasurePlot(LIGHT)
    assert plot.isHidden()
    plot.show_measured(fact(0, 10.0))
    assert not plot.isHidden()
    assert plot.shown == FORCE
    assert list(plot.thresholds) == [2.0]
    assert plot.newest.text() == "now 2.5 N"
    assert plot.notation.text() == "f_1 = λs. F(sense(force, s))"
    assert plot.strip.values == ((-6.0, -2.0, "0"), (-2.0, 0.0, "?"))
    plot.choose("tip <b>")
    assert plot.shown == TIP
    assert list(plot.thresholds) == []
    plot.set_tokens(DARK)
    assert plot.shown == TIP


def test_another_fact_begins_with_its_first_source_and_none_hides_it(qapp: QApplication) -> None:
    plot = MeasurePlot(LIGHT)
    plot.show_measured(fact(0, 10.0))
    plot.choose("tip <b>")
    plot.show_measured(fact(0, 11.0))
    assert plot.shown == TIP
    plot.show_measured(fact(1, 11.0))
    assert plot.shown == FORCE
    plot.show_measured(None)
    assert plot.isHidden()
    assert plot.shown is None


def test_where_nothing_was_measured_it_is_hatched(qapp: QApplication) -> None:
    plot = MeasurePlot(LIGHT, low=True)
    plot.show_measured(MeasuredFact(("SB", 0), "Held", 10.0, (MISSING, NEVER), (), ()))
    assert list(plot.gaps) == [(-9.0, -7.0)]
    plot.choose("tag")
    assert list(plot.gaps) == []
    assert plot.newest.text() == "nothing measured yet"
