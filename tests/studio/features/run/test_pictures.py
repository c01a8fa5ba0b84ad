"""The picture of the world: camera, matrices, normals, and a renderer that draws or gives a
reason."""

from __future__ import annotations

import math
from itertools import product

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QRectF, Qt
from PySide6.QtGui import QColor, QImage
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from smsl_studio.studio.base.theme import LIGHT
from smsl_studio.studio.running.scene.camera import VIEWS, WorldCamera, box_of
from smsl_studio.studio.running.scene.name_places import free_place, is_aside
from smsl_studio.studio.running.scene.plates import EDGE, plates
from smsl_studio.studio.running.scene.renderer import (
    Renderer,
    RenderStyle,
    matrices,
    normals,
    open_renderer,
)
from smsl_studio.studio.running.scene.world_view import WorldView
from smsl_studio.world.protocol import Shape

AHEAD = WorldCamera(target=(0.0, 0.0, 0.0), distance=2.0, azimuth=0.0, elevation=0.0001)


def _wall(y: float, z: float, colour: tuple[float, float, float]) -> Shape:
    """A square of 0.4 m that stands across the x axis, its middle at (0, y, z)."""
    a, b, c, d = (
        (0, y + s, z + t) for s, t in ((-0.2, -0.2), (0.2, -0.2), (0.2, 0.2), (-0.2, 0.2))
    )
    return Shape("wall", (*a, *b, *c, *a, *c, *d), colour, label="w")


STILL = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)


def _pixel(
    camera: WorldCamera, point: tuple[float, float, float], width: int, height: int
) -> tuple[float, float] | None:
    """Where one point (m) is in a picture; None if it is behind the camera."""
    found = camera.pixels(np.array([point]), width, height)
    return None if found is None else (float(found[0, 0]), float(found[0, 1]))


def test_the_target_is_in_the_middle_and_right_is_right() -> None:
    assert _pixel(AHEAD, (0.0, 0.0, 0.0), 200, 100) == pytest.approx((100, 50))
    right = _pixel(AHEAD, (0.0, 0.3, 0.0), 200, 100)
    above = _pixel(AHEAD, (0.0, 0.0, 0.3), 200, 100)
    assert right is not None
    assert above is not None
    assert right[0] > 110
    assert above[1] < 45
    assert _pixel(AHEAD, (3.0, 0.0, 0.0), 200, 100) is None


def test_orbit_pan_and_zoom_stay_sane() -> None:
    camera = AHEAD
    for _ in range(200):
        camera = camera.orbited(0.1, 0.1).zoomed(1.1).panned(0.01, 0.0)
    assert camera.elevation < math.pi / 2
    assert camera.distance <= 8.0
    assert np.isfinite(camera.view_projection(1.5)).all()
    near = AHEAD.zoomed(1e-9).orbited(0.0, -5.0)
    assert near.distance >= 0.1
    assert near.eye[2] > near.target[2]
    for view in VIEWS.values():
        assert np.isfinite(view.view_projection(2.6)).all()


def test_a_view_shows_the_whole_of_what_is_to_be_seen() -> None:
    """A box anywhere and of any size lies inside the picture, from each side."""
    for low, high in (((0.4, -0.2, 0.0), (0.7, 0.1, 0.3)), ((-1.0, -1.0, 0.0), (1.0, 1.0, 1.2))):
        for view in VIEWS.values():
            framed = view.framing((low, high), 800 / 500)
            for x, y, z in product(*zip(low, high, strict=True)):
                at = _pixel(framed, (x, y, z), 800, 500)
                assert at is not None
                assert -20 < at[0] < 820
                assert -20 < at[1] < 520


def test_the_foot_of_a_view_stays_free_and_the_words_there_stand_beside_each_other(
    qtbot: QtBot,
) -> None:
    low, high = (0.4, -0.2, 0.0), (0.7, 0.1, 0.1)
    for view in VIEWS.values():
        framed = view.framing((low, high), 700 / 200, 0.2)
        corners = product(*zip(low, high, strict=True))
        seen = [_pixel(framed, (x, y, z), 700, 200) for x, y, z in corners]
        assert all(at is not None and -5 < at[1] < 160 for at in seen)
    first, second = plates(["Gripper 80 mm", "60 frames/s"])
    assert first.left() == EDGE
    assert first.right() < second.left()


def test_a_small_table_is_seen_nearly_as_large_as_a_large_one() -> None:
    """The table of the dVRK is a third of the others: its view comes nearer."""
    wide = []
    for size in (1.0, 0.35):
        low, high = (0.45, -0.18 * size, 0.0), (0.55, 0.18 * size, 0.06 * size)
        framed = VIEWS["Front"].framing((low, high), 700 / 210)
        left, right = (_pixel(framed, (0.5, side, 0.0), 700, 210) for side in (low[1], high[1]))
        assert left is not None
        assert right is not None
        wide.append(abs(right[0] - left[0]))
    assert wide[1] > 0.7 * wide[0]


def test_the_box_of_shapes_follows_their_poses() -> None:
    wall, half = _wall(0.0, 0.0, (1, 0, 0)), math.sqrt(0.5)
    low, high = box_of([wall, wall], (*STILL, 2.0, 0.0, 1.0, 0.0, 0.0, half, half)) or ((), ())
    assert max(high) >= 2.0
    assert min(low) < 0.0
    assert box_of([], ()) is None


def test_poses_become_matrices() -> None:
    half = math.sqrt(0.5)
    turned = matrices((1.0, 2.0, 3.0, 0.0, 0.0, half, half))[0]
    assert turned @ np.array((1.0, 0.0, 0.0, 1.0)) == pytest.approx((1.0, 3.0, 3.0, 1.0))


def test_normals_are_smooth_over_gentle_edges_only() -> None:
    flat = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], np.float32)
    assert normals(flat) == pytest.approx(np.tile((0, 0, 1), (6, 1)))
    bent = flat.copy()
    bent[4] = (1, 0, 1)
    assert normals(bent)[0] == pytest.approx((0, 0, 1))


def test_the_renderer_draws_what_stands_in_front_or_says_why() -> None:
    renderer = open_renderer()
    if isinstance(renderer, str):
        assert renderer
        return
    renderer.load([_wall(-0.5, 0.0, (1, 0, 0)), _wall(0.5, 0.0, (0, 0, 1))])
    for fine in (True, False):
        image = renderer.draw(STILL * 2, AHEAD, RenderStyle(200, 100, dark=False, fine=fine))
        assert (image.width(), image.height()) == (200, 100)
        left, right = image.pixelColor(60, 45), image.pixelColor(140, 45)
        assert left.red() > 2 * left.blue()
        assert right.blue() > 2 * right.red()
        assert image.pixelColor(100, 5).alpha() == 0
    # Both walls in the middle now, the red one before or behind the blue one, and drawn first.
    turn, blue = (0.0, 0.0, 0.0, 1.0), (0.0, -0.5, 0.0, 0.0, 0.0, 0.0, 1.0)
    before = renderer.draw((0.5, 0.5, 0.0, *turn, *blue), AHEAD, RenderStyle(200, 100, dark=False))
    behind = renderer.draw((-0.5, 0.5, 0.0, *turn, *blue), AHEAD, RenderStyle(200, 100, dark=False))
    assert before.pixelColor(100, 45).red() > 2 * before.pixelColor(100, 45).blue()
    assert behind.pixelColor(100, 45).blue() > 2 * behind.pixelColor(100, 45).red()
    renderer.close()


def test_two_windows_draw_each_their_own_world() -> None:
    first, second = open_renderer(), open_renderer()
    if not isinstance(first, Renderer) or not isinstance(second, Renderer):
        assert first, "without graphics the reason is said"
        return
    first.load([_wall(0, 0, (1, 0, 0))])
    second.load([_wall(0, 0, (0, 0, 1))])
    look, at = RenderStyle(64, 48, False), (0.0,) * 6 + (1.0,)
    red = first.draw(at, AHEAD, look)
    assert second.draw(at, AHEAD, look) != red
    assert first.draw(at, AHEAD, look) == red
    second.close()
    assert first.draw(at, AHEAD, look) == red
    first.close()


def test_a_drag_turns_the_camera_and_a_double_click_comes_back(qtbot: QtBot) -> None:
    class Painter(Renderer):
        """Draws one colour, and remembers from where."""

        def __init__(self) -> None:
            self.seen: list[WorldCamera] = []

        def load(self, shapes: object) -> None: ...

        def draw(self, poses: object, camera: WorldCamera, look: RenderStyle) -> QImage:
            self.seen.append(camera)
            image = QImage(look.width, look.height, QImage.Format.Format_RGBA8888_Premultiplied)
            image.fill(QColor("red"))
            return image

    painter = Painter()
    view = WorldView(LIGHT)
    qtbot.addWidget(view)
    view._renderer = painter
    view.resize(300, 200)
    view.load([_wall(0.0, 0.0, (1, 0, 0))], "bench")
    view.show_poses(STILL, {"holding": "disk 3"})
    with qtbot.waitSignal(view.drawn):
        view.show()
    QTest.mousePress(view, Qt.MouseButton.LeftButton, pos=QPoint(100, 100))
    with qtbot.waitSignal(view.drawn):
        QTest.mouseMove(view, QPoint(160, 100))
    QTest.mouseRelease(view, Qt.MouseButton.LeftButton, pos=QPoint(160, 100))
    assert painter.seen[-1].azimuth < painter.seen[0].azimuth
    with qtbot.waitSignal(view.drawn):
        QTest.mouseDClick(view, Qt.MouseButton.LeftButton, pos=QPoint(100, 100))
    assert painter.seen[-1] == painter.seen[0]
    seen = len(painter.seen)
    view.show_poses(STILL, {"holding": "disk 3"})
    view.repaint()
    assert len(painter.seen) == seen


def test_the_name_of_a_thing_stays_near_it_and_over_no_other() -> None:
    feet = [(100.0, 100.0), (104.0, 103.0), (90.0, 118.0), (300.0, 40.0)]
    taken: list[QRectF] = []
    for x, y in feet:
        place = free_place((x, y), 40.0, taken)
        assert not any(place.intersects(other) for other in taken)
        assert math.dist((place.center().x(), place.center().y()), (x, y)) < 60
        taken.append(place)
    assert taken[3].top() == 48.0, "a name that is alone stands below its thing"
    assert [is_aside(one, foot) for one, foot in zip(taken, feet, strict=True)] == [
        False,
        True,
        True,
        False,
    ]


def test_a_name_stays_in_the_picture_if_there_is_room() -> None:
    room = QRectF(0.0, 0.0, 200.0, 100.0)
    for foot in ((100.0, 95.0), (5.0, 50.0), (198.0, 99.0)):
        assert room.contains(free_place(foot, 40.0, [], room))


def test_very_many_names_at_one_place_take_no_time() -> None:
    taken: list[QRectF] = []
    for _ in range(300):
        taken.append(free_place((50.0, 50.0), 40.0, taken))
    assert len({(one.x(), one.y()) for one in taken}) > 50
