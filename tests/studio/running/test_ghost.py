"""The ghost of a forecast: when it moves, where it is, and how it is drawn."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
from PySide6.QtCore import QObject, QSizeF
from PySide6.QtGui import QColor, QImage, QPainter
from pytestqt.qtbot import QtBot

from smsl_studio.studio.base.calm import set_calm
from smsl_studio.studio.base.theme import LIGHT
from smsl_studio.studio.running.forecast_bar import ForecastBar
from smsl_studio.studio.running.scene.camera import WorldCamera
from smsl_studio.studio.running.scene.ghost import BOTH, FORECAST, NOW, Ghost, GhostPlace
from smsl_studio.studio.running.scene.ghost_paint import paint_ghost_words
from smsl_studio.studio.running.scene.kept_poses import KeptPoses
from smsl_studio.studio.running.scene.renderer import (
    GhostPoses,
    Renderer,
    RenderStyle,
    moved_shapes,
    open_renderer,
)
from smsl_studio.world.protocol import Shape

AHEAD = WorldCamera(target=(0.0, 0.0, 0.0), distance=2.0, azimuth=0.0, elevation=0.0001)
REST = (0.0, 0.0, 0.0, 1.0)


def poses(y: float) -> tuple[float, ...]:
    """Two shapes: the first stays, the second is ``y`` metres to the right."""
    return (0.0, -0.4, 0.0, *REST, 0.0, y, 0.0, *REST)


def frames(seconds: float) -> KeptPoses:
    """The second shape goes 0.1 m a second."""
    kept = KeptPoses(0.5)
    for number in range(int(seconds * 2) + 1):
        kept.add(3.0 + number / 2, poses(number * 0.05))
    return kept


@pytest.fixture
def ghost(qtbot: QtBot) -> Iterator[Ghost]:
    owner = QObject()
    made = Ghost(owner)
    yield made
    made.show(None)


def test_a_ghost_goes_through_its_forecast_once_and_stays_at_its_end(ghost: Ghost) -> None:
    assert ghost.place is None
    shown = frames(4)
    ghost.show(shown)
    assert ghost.playing
    ghost.go_on(1.25)
    assert ghost.place is not None
    assert ghost.place.poses == pytest.approx(poses(0.125))
    ghost.go_on(99)
    assert not ghost.playing
    assert ghost.place.words == "Forecast at 4.0 s"
    assert ghost.place.poses == pytest.approx(poses(0.4))
    ghost.show(shown)
    assert not ghost.playing, "the same forecast moves once"
    ghost.show(frames(4))
    assert ghost.playing
    ghost.show(None)
    assert (ghost.place, ghost.playing, ghost.seconds) == (None, False, 0.0)


def test_a_long_forecast_is_shown_faster_and_who_wants_less_motion_sees_its_end(
    ghost: Ghost,
) -> None:
    ghost.show(frames(60))
    ghost.go_on(3)
    assert ghost.time == pytest.approx(30)
    set_calm(True)
    try:
        ghost.show(frames(8))
    finally:
        set_calm(False)
    assert (ghost.playing, ghost.time) == (False, 8)


def test_the_bar_moves_the_ghost_alone_and_chooses_what_is_seen(ghost: Ghost, qtbot: QtBot) -> None:
    bar = ForecastBar(ghost, LIGHT)
    qtbot.addWidget(bar)
    assert bar.isHidden()
    ghost.show(frames(4))
    assert not bar.isHidden()
    bar.slider.setValue(500)
    assert (ghost.playing, ghost.time, bar.words.text()) == (False, 2.0, "2.0 of 4.0 s")
    seen = {action.text(): action for action in bar.seen.menu().actions()}
    assert list(seen) == [NOW, FORECAST, BOTH]
    seen[NOW].trigger()
    assert ghost.place is None
    seen[FORECAST].trigger()
    assert ghost.place is not None
    assert ghost.place.alone
    bar.play.click()
    assert (ghost.playing, ghost.time) == (True, 0.0)


def test_poses_between_two_kept_ones_are_mixed_and_a_rotation_goes_the_short_way() -> None:
    kept = KeptPoses(0.5)
    half = (0.0, 0.0, 2**-0.5, -(2**-0.5))
    kept.add(1.0, (0.0, 0.0, 0.0, *REST))
    kept.add(2.0, (1.0, 0.0, 0.0, *half))
    assert kept.at(-1)[:3] == (0.0, 0.0, 0.0)
    x, _, _, *turned = kept.at(0.5)
    assert x == pytest.approx(0.5)
    # From 0 to -90 degrees about z: half of it is -45 degrees.
    assert turned == pytest.approx([0.0, 0.0, -0.38268343, 0.92387953], abs=1e-6)
    assert KeptPoses().at(1.0) == ()


def test_only_what_stands_elsewhere_has_a_ghost() -> None:
    assert moved_shapes(poses(0.0), poses(0.2)) == {1}
    flipped = tuple(-v if n % 7 >= 3 else v for n, v in enumerate(poses(0.0)))
    assert moved_shapes(poses(0.0), flipped) == frozenset()
    assert moved_shapes(poses(0.0), poses(0.0)[:7]) == frozenset()


def _wall() -> tuple[float, ...]:
    a, b, c, d = (
        (0.0, s, t) for s, t in ((-0.05, -0.05), (0.05, -0.05), (0.05, 0.05), (-0.05, 0.05))
    )
    return (*a, *b, *c, *a, *c, *d)


@pytest.fixture
def renderer() -> Iterator[Renderer]:
    made = open_renderer()
    if isinstance(made, str):
        pytest.fail(f"no OpenGL: {made}")
    made.load(
        [Shape("left", _wall(), (0.1, 0.1, 0.1)), Shape("right", _wall() * 2, (0.0, 1.0, 0.0))]
    )
    yield made
    made.close()


def _colour(image: QImage, y: float) -> QColor:
    """The colour where the middle of a shape is that stands so far to the right (m)."""
    at = AHEAD.pixels(np.array([[0.0, y, 0.02]]), 200, 100)
    assert at is not None
    return QColor.fromRgba(image.pixel(round(at[0, 0]), round(at[0, 1])))


def test_a_ghost_is_translucent_once_and_what_is_alone_is_not_drawn_where_it_is(
    renderer: Renderer,
) -> None:
    """The right shape has each of its triangles twice, and its ghost is as clear all the same."""
    red = (1.0, 0.0, 0.0)
    both = RenderStyle(200, 100, False, False, GhostPoses(poses(0.3), red))
    image = renderer.draw(poses(0.0), AHEAD, both)
    assert _colour(image, 0.3).alpha() == round(0.58 * 255)
    assert _colour(image, 0.3).red() > 100 > _colour(image, 0.3).green()
    assert _colour(image, 0.0).alpha() == 255
    assert _colour(image, 0.0).green() > 100
    assert _colour(image, -0.4).red() < 100, "what stays has no ghost"
    alone = RenderStyle(200, 100, False, False, GhostPoses(poses(0.3), red, alone=True))
    image = renderer.draw(poses(0.0), AHEAD, alone)
    assert _colour(image, 0.0).green() < 100
    assert _colour(image, 0.3).alpha() == round(0.58 * 255)


def test_the_words_of_a_ghost_stay_in_the_picture(qtbot: QtBot) -> None:
    image = QImage(300, 200, QImage.Format.Format_ARGB32)
    painter = QPainter(image)
    seen = []
    for y in (-0.4, 0.0, 0.45, 3.0):
        place = GhostPlace(poses(y), 1.0, 4.0, (poses(0.0), poses(y)))
        seen.append(paint_ghost_words(painter, QSizeF(300, 200), AHEAD, place, 1, LIGHT))
    painter.end()
    *inside, outside = seen
    assert outside.isEmpty()
    for box in inside:
        assert box.left() >= 8
        assert box.right() <= 292
