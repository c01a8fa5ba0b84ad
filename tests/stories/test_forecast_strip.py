"""The forecast in Supervise: of the operation at hand, while the run goes on without it."""

from __future__ import annotations

from collections.abc import Mapping

import pytest
from PySide6.QtCore import Qt

from smsl_studio.blueprint.address import Address
from smsl_studio.front.twin import Twin
from smsl_studio.library.prediction import DIFFERS, NONE, Prediction
from smsl_studio.studio.features.supervise.forecast_strip import ForecastStrip
from tests.stories.at_supervise import AtSupervise
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES

Key = Qt.Key
HANOI = SAMPLES / "hanoi-2.json"


def said(at: AtSupervise, words: str) -> ForecastStrip:
    strip = at.pane.forecast

    def there() -> None:
        assert words in strip.accessibleDescription(), strip.accessibleDescription()

    at.person.qtbot.waitUntil(there)
    return strip


def test_the_operation_at_hand_has_a_forecast_and_another_one_when_it_is_chosen(sit: Sit) -> None:
    at = AtSupervise(sit(HANOI, (1280, 800)))
    assert not at.pane.forecast.isVisible()
    at.start_paused()
    strip = said(at, "Forecast of Op_2c: agrees. Fact 2: a → c")
    assert strip.isVisible()
    assert "A forecast is no evidence" in strip.toolTip()
    at.press(at.number("Op_1c"))
    said(at, "Forecast of Op_1c: agrees. Fact 1: b → c")
    at.press(Key.Key_Escape)
    said(at, "Forecast of Op_2c: agrees")
    at.person.click(strip.anew)
    said(at, "Forecast of Op_2c: agrees")
    at.press(Key.Key_F5)
    at.person.qtbot.waitUntil(lambda: at.run.over)
    at.person.qtbot.waitUntil(lambda: not strip.isVisible())


def test_what_differs_and_what_has_no_forecast_is_said(
    sit: Sit, monkeypatch: pytest.MonkeyPatch
) -> None:
    told = Prediction(DIFFERS, {"SB1/1": "x"}, "SB1/1 will be x, not c")
    asked: list[str] = []

    def predict(_twin: Twin, _configuration: Mapping[str, str], edge: Address) -> Prediction:
        asked.append(edge.operation)
        return told

    monkeypatch.setattr(Twin, "predict", predict)
    at = AtSupervise(sit(HANOI))
    at.start_paused()
    strip = said(at, "Forecast of Op_2c: differs. SB1/1 will be x, not c")
    told = Prediction(NONE, reason="a person carries it out")
    at.person.click(strip.anew)
    said(at, "No forecast of Op_2c: a person carries it out")
    assert asked == ["Op_2c", "Op_2c"]


def test_the_forecast_and_its_world_are_given_up_where_nobody_sees_them(sit: Sit) -> None:
    at = AtSupervise(sit(HANOI))
    at.start_paused()
    said(at, "agrees")
    at.person.ctrl(Key.Key_1)
    assert at.pane.forecaster.view is None
    at.person.ctrl(Key.Key_3)
    said(at, "agrees")


def test_facts_that_change_make_a_forecast_old(sit: Sit) -> None:
    at = AtSupervise(sit(HANOI))
    at.start_paused()
    strip = said(at, "agrees")
    view, status = at.pane.forecaster.view, at.run.status
    assert view is not None
    assert status is not None
    strip.show_forecast(at.run.blueprint, view, {**view.before, "SB1/1": None}, False)
    assert "out of date" in strip.accessibleDescription()
    strip.show_forecast(at.run.blueprint, view, {**view.before, "SB1/1": None}, True)
    assert "agrees" in strip.accessibleDescription()
