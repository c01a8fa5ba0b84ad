"""The forecast in the scene of a run: while an operation is proposed, and no longer."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import pytest
from PySide6.QtGui import QColor, QImage
from pytestqt.qtbot import QtBot

from smsl_studio.blueprint.address import Address
from smsl_studio.dispatch.execution.status import DispatchStatus
from smsl_studio.library.prediction import AGREES, Prediction
from smsl_studio.studio.base.theme import LIGHT
from smsl_studio.studio.running.forecaster import ForecastView
from smsl_studio.studio.running.run_choice import RunChoice
from smsl_studio.studio.running.run_session import RunSession
from smsl_studio.studio.running.scene import world_view
from smsl_studio.studio.running.scene.camera import WorldCamera
from smsl_studio.studio.running.scene.kept_poses import KeptPoses
from smsl_studio.studio.running.scene.renderer import Renderer, RenderStyle
from smsl_studio.studio.running.world_pane import WorldPane
from smsl_studio.world.protocol import Shape
from tests.front.views.statuses import sample, status

SAMPLE = sample("hanoi-2.json")
EDGE = Address("SB1", "State_aa", "Op_1b")
HERE = status({"SB1": "State_aa"}, route=(EDGE,), phase="paused")
REST = (0.0, 0.0, 0.0, 1.0)
NOW = (0.4, 0.0, 0.0, *REST)


class Painter(Renderer):
    """Remembers what it was asked to draw."""

    def __init__(self) -> None:
        self.seen: list[RenderStyle] = []

    def load(self, shapes: object) -> None: ...

    def close(self) -> None: ...

    def draw(self, poses: Sequence[float], camera: WorldCamera, look: RenderStyle) -> QImage:
        self.seen.append(look)
        image = QImage(look.width, look.height, QImage.Format.Format_RGBA8888_Premultiplied)
        image.fill(QColor("white"))
        return image


class StandingRun(RunSession):
    """A run that stands where it is told, in a world with one thing."""

    def __init__(self) -> None:
        super().__init__()
        self.blueprint, self.choice = SAMPLE, RunChoice("hanoi")
        self.shapes = (Shape("thing", (0.0, 0.0, 0.0, 0.1, 0.0, 0.0, 0.0, 0.1, 0.0), (1, 0, 0)),)
        self.followed: list[Address | None] = []

    @property
    def exists(self) -> bool:
        return True

    def poses(self) -> tuple[float, ...]:
        return NOW

    def stand(self, where: DispatchStatus) -> None:
        self.status = where
        self.changed.emit()

    def follow(self, _asked: Any, _status: Any, edge: Address | None) -> None:
        self.followed.append(edge)

    def foresee(self, seconds: float) -> None:
        """Have a forecast that moves the thing."""
        frames = KeptPoses(0.5)
        for number in range(int(2 * seconds) + 1):
            frames.add(number / 2, (0.4, number * 0.1, 0.0, *REST))
        found = Prediction(AGREES, {})
        self.forecaster.view = ForecastView(EDGE, {}, found, frames=frames)
        self.forecaster.changed.emit()


@pytest.fixture
def run(monkeypatch: pytest.MonkeyPatch) -> StandingRun:
    monkeypatch.setattr(world_view, "open_renderer", Painter)
    made = StandingRun()
    monkeypatch.setattr(made.forecaster, "follow", made.follow)
    return made


def shown(run: StandingRun, qtbot: QtBot, watches: bool = False) -> WorldPane:
    pane = WorldPane(run, LIGHT, watches)
    qtbot.addWidget(pane)
    pane.resize(600, 300)
    run.changed.connect(lambda: pane.show_facts(()))
    pane.show()
    pane.load()
    return pane


def test_a_proposed_operation_is_forecast_and_moves_a_ghost_once(
    run: StandingRun, qtbot: QtBot
) -> None:
    pane = shown(run, qtbot)
    assert not run.followed
    run.stand(HERE)
    assert run.followed == [EDGE]
    assert not pane.moment.isVisible()
    run.foresee(4)
    assert pane.ghost.playing
    assert pane.moment.isVisible()
    pane.ghost.seek(4)
    pane.grab()
    renderer = pane.view._renderer
    assert isinstance(renderer, Painter)
    ghost = renderer.seen[-1].ghost
    assert ghost is not None
    assert ghost.poses == pytest.approx((0.4, 0.8, 0.0, *REST))
    run.stand(HERE)
    assert not pane.ghost.playing, "the same forecast moves once"
    run.stand(replace(HERE, phase="running", running=EDGE))
    assert (pane.ghost.seconds, pane.moment.isVisible()) == (0, False)
    pane.grab()
    assert renderer.seen[-1].ghost is None


def test_while_a_run_goes_on_by_itself_nothing_is_forecast_in_run(
    run: StandingRun, qtbot: QtBot
) -> None:
    """Between two operations as well. One who only watches leaves it to another part."""
    shown(run, qtbot)
    run.stand(replace(HERE, phase="running"))
    assert not run.followed
    shown(run, qtbot, watches=True)
    run.followed.clear()
    run.stand(HERE)
    assert run.followed == [EDGE], "by the first alone"


def test_what_is_shown_again_while_a_run_rests_is_forecast_then(
    run: StandingRun, qtbot: QtBot
) -> None:
    pane = shown(run, qtbot)
    pane.hide()
    run.stand(HERE)
    assert not run.followed
    pane.show()
    assert run.followed == [EDGE]
