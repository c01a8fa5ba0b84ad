"""The forecast in Supervise: of the operation at hand, while the run goes on without it."""

from __future__ import annotations

import threading
from collections.abc import Mapping

import pytest
from PySide6.QtCore import Qt

from smsl_studio.blueprint.address import Address
from smsl_studio.front import twin_process
from smsl_studio.front.twin_process import TwinProcess, Watch
from smsl_studio.host.started_child import Child, start_child
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
    reason = "SB1/1 will be x, not c"
    told = Prediction(DIFFERS, {"SB1/1": "x"}, reason, apart=("SB1/1",))
    asked: list[str] = []

    def predict(
        _twin: TwinProcess, _configuration: Mapping[str, str], edge: Address, _watch: Watch
    ) -> Prediction:
        asked.append(edge.operation)
        return told

    monkeypatch.setattr(TwinProcess, "predict", predict)
    at = AtSupervise(sit(HANOI))
    at.start_paused()
    strip = said(at, f"Forecast of Op_2c: differs. Fact 2 will be x\n{reason}")
    card = at.pane.board.cards[at.number("Op_2c") - Key.Key_1]
    assert card.accessibleName().endswith("forecast differs: Fact 2 will be x")
    assert "Forecast differs: Fact 2 will be x" in card.toolTip()
    told = Prediction(NONE, reason="a person carries it out")
    at.person.click(strip.anew)
    said(at, "No forecast of Op_2c: a person carries it out")
    assert asked == ["Op_2c", "Op_2c"]


def test_one_process_serves_a_run_and_is_given_up_with_it(
    sit: Sit, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Another operation, or the page left and shown again, starts no other one."""
    started: list[Child] = []

    def start(module: str) -> Child:
        started.append(start_child(module))
        return started[-1]

    monkeypatch.setattr(twin_process, "start_child", start)
    at = AtSupervise(sit(HANOI))
    at.start_paused()
    said(at, "Forecast of Op_2c: agrees")
    at.press(at.number("Op_1c"))
    said(at, "Forecast of Op_1c: agrees")
    at.press(Key.Key_Escape)
    said(at, "Forecast of Op_2c: agrees")
    for _ in range(2):
        at.person.ctrl(Key.Key_1)
        at.person.ctrl(Key.Key_3)
    at.person.click(said(at, "Forecast of Op_2c: agrees").anew)
    said(at, "Forecast of Op_2c: looking")
    said(at, "Forecast of Op_2c: agrees")
    (child,) = started
    assert not child.dead
    at.person.ctrl(Key.Key_2)
    at.press(Key.Key_F5)
    at.person.qtbot.waitUntil(lambda: at.run.over)
    assert at.pane.forecaster.view is None
    at.person.qtbot.waitUntil(lambda: child.dead)


def test_the_route_is_forecast_onward_and_the_card_says_what_agrees(sit: Sit) -> None:
    at = AtSupervise(sit(SAMPLES / "hanoi-corrected.json", (1280, 800)))
    at.start_paused()
    strip = said(at, "2  Op_1b agrees. Fact 1: c → b    3  Op_3c agrees. Fact 3: a → c")
    assert strip.onward.isVisible()
    told = {card.card.name: card.accessibleName() for card in at.pane.board.cards}
    assert "forecast agrees" in told.pop("Op_2b")
    assert not any("forecast" in words for words in told.values())


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


def test_the_process_of_a_forecast_ends_with_its_window(
    sit: Sit, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Also where the thread that asks for forecasts is busy, and takes no further task."""
    started: list[Child] = []
    asks, over = threading.Event(), threading.Event()

    def start(module: str) -> Child:
        started.append(start_child(module))
        return started[-1]

    def predict(*_: object) -> Prediction:
        asks.set()
        over.wait()
        return Prediction(NONE)

    monkeypatch.setattr(twin_process, "start_child", start)
    monkeypatch.setattr(TwinProcess, "predict", predict)
    at = AtSupervise(sit(HANOI))
    at.start_paused()
    at.person.qtbot.waitUntil(asks.is_set)
    (child,) = started
    try:
        at.person.window.features.stop()
        assert child.dead
    finally:
        over.set()
