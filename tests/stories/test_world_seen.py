"""The picture of the world shows the newest pose, also of a run that ended out of view."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QImage
from pytestqt.qtbot import QtBot

from smsl_studio.studio.base.theme import LIGHT
from smsl_studio.studio.running.scene import world_view
from smsl_studio.studio.running.scene.camera import WorldCamera
from smsl_studio.studio.running.scene.renderer import Renderer, RenderStyle
from smsl_studio.studio.running.scene.world_view import WorldView
from smsl_studio.world.protocol import Shape
from tests.stories.at_run import AtRun
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES
from tests.stories.test_files import copy_of

Key = Qt.Key


class Painter(Renderer):
    """Draws one colour, and remembers at which poses."""

    def __init__(self) -> None:
        self.seen: list[tuple[float, ...]] = []

    def load(self, shapes: object) -> None: ...

    def close(self) -> None: ...

    def draw(self, poses: Sequence[float], camera: WorldCamera, look: RenderStyle) -> QImage:
        self.seen.append(tuple(poses))
        image = QImage(look.width, look.height, QImage.Format.Format_RGBA8888_Premultiplied)
        image.fill(QColor("red"))
        return image


@pytest.mark.parametrize("away", [Key.Key_1, Key.Key_3])
def test_a_run_that_ended_out_of_view_is_shown_as_it_ended(
    sit: Sit, monkeypatch: pytest.MonkeyPatch, away: Key
) -> None:
    painter = Painter()
    monkeypatch.setattr(world_view, "open_renderer", lambda: painter)
    person = sit(SAMPLES / "hanoi-corrected.json")
    run = AtRun(person)
    run.choose(world="hanoi", goal="caa")
    run.as_fast_as_it_goes()
    person.press(Key.Key_F5)
    run.until_runs()
    person.ctrl(away)
    run.until_phase("Goal reached")
    person.ctrl(Key.Key_2)
    newest = run.pane.run.poses()
    assert newest
    person.qtbot.waitUntil(lambda: bool(painter.seen) and painter.seen[-1] == newest)


def test_a_step_is_watched_beside_the_text_with_its_world(
    sit: Sit, monkeypatch: pytest.MonkeyPatch
) -> None:
    painter = Painter()
    monkeypatch.setattr(world_view, "open_renderer", lambda: painter)
    person = sit(SAMPLES / "hanoi-corrected.json")
    review = person.window.features.review
    person.ctrl(Key.Key_4)
    person.until(lambda: review.review.seen is not None)
    seen = review.review.seen
    assert seen is not None
    step = next(one for one in seen.lines if one.line.about and one.line.about[0].operation)
    review.page.show_line(step.line.key)
    person.press(Key.Key_W)
    column = review.watching()
    person.until(lambda: column.world.has_picture and len(set(painter.seen)) > 2)
    assert column.world.isVisible()
    run = person.window.features.run.pane.run
    person.press(Key.Key_F8)
    person.until(lambda: run.phase == "stopped")
    person.until(lambda: painter.seen[-1] == run.poses())
    person.click(column.leave)
    assert not column.isVisible()


def test_beside_a_step_nothing_of_the_run_of_another_file_is_shown(
    sit: Sit, tmp_path: Path
) -> None:
    person = sit(SAMPLES / "hfsm.json")
    run = AtRun(person)
    run.choose(world="table")
    person.press(Key.Key_F10)
    run.until_done(1)
    person.ctrl(Key.Key_1)
    person.window.open_path(copy_of("hanoi-2.json", tmp_path))
    review = person.window.features.review
    person.ctrl(Key.Key_4)
    person.until(lambda: review.review.seen is not None)
    seen = review.review.seen
    assert seen is not None
    step = next(one for one in seen.lines if one.line.about and one.line.about[0].operation)
    review.page.show_line(step.line.key)
    person.press(Key.Key_W)
    column = review.watching()
    assert column.isVisible()
    assert "a run of hfsm.json" in column.said.text()
    assert not column.canvas.isVisible()
    assert not column.facts.isVisible()
    run.pane.run.finish()
    person.until(lambda: not run.pane.run.exists)
    person.press(Key.Key_W)
    person.until(column.canvas.isVisible)
    assert column.facts.isVisible()


def test_the_last_pose_is_drawn_however_long_a_picture_takes(
    qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    painter = Painter()
    monkeypatch.setattr(world_view, "open_renderer", lambda: painter)
    clock = iter(range(0, 100_000, 10))
    monkeypatch.setattr(world_view, "perf_counter", lambda: float(next(clock)))
    view = WorldView(LIGHT)
    qtbot.addWidget(view)
    view.resize(300, 200)
    still = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)
    view.load([Shape("box", (0.0, 0.0, 0.0) * 3, (1.0, 0.0, 0.0))], "bench")
    view.show_poses(still, {})
    with qtbot.waitSignal(view.drawn):
        view.show()
    moved = (0.5, *still[1:])
    view.show_poses(moved, {})
    view.repaint()
    assert painter.seen[-1] == still, "pictures take 10 s here, so a pose between is left out"
    view.show_poses(moved, {}, last=True)
    view.repaint()
    assert painter.seen[-1] == moved
