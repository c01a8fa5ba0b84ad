"""Saving what the picture of a world shows: one picture, or a clip of what was watched."""

from __future__ import annotations

from io import BytesIO
from itertools import pairwise
from pathlib import Path

import pytest
from PIL import Image, ImageSequence
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from smsl_studio.stop import Stopped, heeding
from smsl_studio.studio.base.theme import LIGHT
from smsl_studio.studio.base.toast import Toast
from smsl_studio.studio.features.run import picture_file
from smsl_studio.studio.features.run.picture_file import ClipSaver, save_picture
from smsl_studio.studio.running.scene.clip_file import ClipFrame, clip_bytes
from smsl_studio.studio.running.scene.kept_poses import EVERY, MOST, KeptPoses
from smsl_studio.studio.running.scene.world_view import WorldView
from smsl_studio.world.protocol import Shape

WALL = Shape("wall", (0, -0.2, 0, 0, 0.2, 0, 0, 0.2, 0.4), (1.0, 0.0, 0.0))


def at(y: float) -> tuple[float, ...]:
    return (0.5, y, 0.0, 0.0, 0.0, 0.0, 1.0)


@pytest.fixture
def window(qtbot: QtBot) -> QWidget:
    window = QWidget()
    window.resize(400, 300)
    qtbot.addWidget(window)
    return window


@pytest.fixture
def view(qtbot: QtBot, window: QWidget) -> WorldView:
    view = WorldView(LIGHT, window)
    view.resize(321, 200)
    view.load([WALL], "here")
    view.show_poses(at(0.0), {})
    return view


@pytest.fixture
def toast(window: QWidget) -> Toast:
    return Toast(LIGHT, window)


def count_of(clip: Image.Image) -> int:
    """The number of pictures of a clip."""
    return sum(1 for _ in ImageSequence.Iterator(clip))


def answer(monkeypatch: pytest.MonkeyPatch, path: Path) -> None:
    monkeypatch.setattr(picture_file, "ask_to_save", lambda *_: (str(path), ""))


def kept(count: int) -> KeptPoses:
    found = KeptPoses()
    for number in range(count):
        found.add(number * EVERY * 1.001, at(number / 100))
    return found


def test_poses_are_kept_evenly_and_never_more_than_so_many() -> None:
    found = kept(3 * MOST)
    assert MOST / 2 < len(found) <= MOST
    assert found.seconds == pytest.approx(3 * MOST * EVERY, rel=0.02)
    shown = [poses[1] for poses in found.spread(7)]
    assert len(shown) == 7
    steps = [b - a for a, b in pairwise(shown)]
    assert max(steps) < 1.1 * min(steps)
    assert len(kept(3).spread(7)) == 3
    found.add(0.0, at(5.0))
    assert len(found) == 1, "another run has begun"


def test_a_pose_between_two_kept_ones_is_left_out() -> None:
    found = KeptPoses()
    for time in (0.0, 0.04, 0.08, 0.12):
        found.add(time, at(time))
    assert [poses[1] for poses in found.spread(9)] == pytest.approx([0.0, 0.12])
    found.add(0.5, ())
    assert len(found) == 2


@pytest.mark.parametrize("suffix", [".gif", ".webp"])
def test_a_clip_has_all_pictures_in_their_order_and_time(suffix: str) -> None:
    frames = [ClipFrame(bytes((40 * n, 0, 200)) * 64 * 32, 64, 32) for n in range(5)]
    with Image.open(BytesIO(clip_bytes(frames, suffix, 80))) as clip:
        assert (clip.format, clip.size, count_of(clip)) == (suffix[1:].upper(), (64, 32), 5)
        for number in range(5):
            clip.seek(number)
            red, _, blue = clip.convert("RGB").getpixel((9, 9))  # type: ignore[misc]
            assert abs(red - 40 * number) < 12
            assert abs(blue - 200) < 12
            assert clip.info["duration"] == (80 if number < 4 else 1500)


def test_a_clip_can_be_called_off_between_two_pictures() -> None:
    frames = [ClipFrame(bytes(3) * 4, 2, 2)] * 5

    def end() -> None:
        raise Stopped

    with heeding(end), pytest.raises(Stopped):
        clip_bytes(frames, ".gif", 80)


def test_a_picture_is_saved_as_it_is_seen(
    view: WorldView, toast: Toast, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert view.has_picture, view.sentence
    answer(monkeypatch, tmp_path / "seen.png")
    save_picture(view, tmp_path / "x", toast, view.window())
    found = QImage(str(tmp_path / "seen.png"))
    assert (found.width(), found.height()) == (321, 200)
    assert view.picture(at(0.3)) != view.picture(at(-0.3))


def test_the_camera_goes_with_the_tool_if_that_is_wanted(view: WorldView) -> None:
    view.follow(True)
    assert view.picture(at(0.3)) != view.picture()
    near = view.picture(at(0.1))
    view.show_poses(at(0.1), {})
    assert view.picture() == near
    view.follow(False)


def test_a_clip_is_saved_while_the_window_goes_on(
    qtbot: QtBot, view: WorldView, toast: Toast, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "run.gif"
    answer(monkeypatch, path)
    saver = ClipSaver(view, toast, view.window())
    before = view.picture()
    saver.save(kept(6), tmp_path / "x")
    assert saver.busy
    assert not path.exists()
    qtbot.waitUntil(path.exists)
    with Image.open(path) as clip:
        assert (count_of(clip), clip.size) == (6, (321, 200))
    assert not saver.busy
    assert view.picture() == before


def test_a_clip_that_is_cancelled_leaves_no_file(
    qtbot: QtBot, view: WorldView, toast: Toast, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    answer(monkeypatch, tmp_path / "run.webp")
    saver = ClipSaver(view, toast, view.window())
    saver.save(kept(200), tmp_path / "x")
    saver.cancel()
    assert not saver.busy
    saver.stop()
    assert list(tmp_path.iterdir()) == []


def test_a_clip_of_a_world_that_is_gone_is_given_up(
    qtbot: QtBot, view: WorldView, toast: Toast, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    answer(monkeypatch, tmp_path / "run.gif")
    saver = ClipSaver(view, toast, view.window())
    saver.save(kept(50), tmp_path / "x")
    view.load([WALL, WALL], "another")
    qtbot.waitUntil(lambda: not saver.busy)
    assert list(tmp_path.iterdir()) == []


def test_a_clip_of_another_kind_is_refused(
    view: WorldView, toast: Toast, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    answer(monkeypatch, tmp_path / "run.mp4")
    saver = ClipSaver(view, toast, view.window())
    saver.save(kept(3), tmp_path / "x")
    assert not saver.busy
    assert toast.severity == "E"
