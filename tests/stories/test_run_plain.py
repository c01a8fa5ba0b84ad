"""A run without physics that a person can follow: tiles that move, and the operation as a bar."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from smsl_studio import front
from smsl_studio.front.views.fact_tiles import FactTile
from smsl_studio.studio.base.theme import DARK, LIGHT
from smsl_studio.studio.running import operation_time
from smsl_studio.studio.running.world_pane import WorldPane
from tests.stories.at_run import AtRun
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES

Key = Qt.Key
HANOI, FAILURES = SAMPLES / "hanoi-corrected.json", SAMPLES / "registration-failures.json"
LONG = 1e6


def _scene(run: AtRun) -> WorldPane:
    return run.pane.scene


def _tiles(run: AtRun) -> tuple[FactTile, ...]:
    return _scene(run).tiles.tiles.tiles


def _said(run: AtRun) -> list[str]:
    """The tiles as a screen reader reads them."""
    model = _scene(run).tiles.model()
    role = Qt.ItemDataRole.AccessibleTextRole
    return [str(model.index(row, 0).data(role)) for row in range(model.rowCount())]


def _plays(sit: Sit, path: object = HANOI, **size: tuple[int, int]) -> AtRun:
    run = AtRun(sit(path, **size))
    run.choose("table")
    run.person.press(Key.Key_F5)
    return run


def test_an_operation_can_be_followed_paused_and_finished(
    sit: Sit, monkeypatch: pytest.MonkeyPatch
) -> None:
    run = AtRun(sit(HANOI))
    monkeypatch.setattr(operation_time, "USUAL", LONG)
    run.choose("table")
    assert not _scene(run).shows_tiles
    run.person.press(Key.Key_F5)
    run.person.until(lambda: _scene(run).bar.share is not None)
    assert _scene(run).shows_tiles
    assert _scene(run).bar.words == "Op_1c, from aaa to caa"
    assert _scene(run).bar.time.endswith("of 1000000.0 s")
    assert _scene(run).bar.time.startswith("shown for "), "it is not the time of the run"
    assert "In the simulated time of the run" in _scene(run).bar.toolTip()
    assert "Simulated 0.0 s" in run.pane.words[0]
    assert _said(run)[0] == "Fact 1: a, moving to c"
    assert [tile.target for tile in _tiles(run)] == ["c", "", ""]
    run.person.until(lambda: _scene(run).bar.share not in (None, 0.0))
    marks = run.pane.canvas.canvas.marks
    assert marks.running is not None
    assert marks.running[1] is not None
    assert marks.running_words.startswith("shown for ")
    run.person.press(Key.Key_F6)
    run.until_phase("Paused")
    assert _said(run)[0].startswith("Fact 1: a")
    run.as_fast_as_it_goes()
    monkeypatch.setattr(operation_time, "USUAL", 0.0)
    run.person.press(Key.Key_F10)
    run.until_done(1)
    assert _said(run)[0] == "Fact 1: c"
    assert _scene(run).bar.words == "Next: Op_2b"
    run.person.press(Key.Key_F5)
    run.until_phase("Goal reached")
    assert _said(run) == ["Fact 1: c", "Fact 2: c", "Fact 3: c"]
    assert _scene(run).bar.share is None


def test_the_events_are_those_of_a_run_without_a_window(sit: Sit) -> None:
    run = _plays(sit)
    run.until_phase("Goal reached")
    headless = front.run(front.read(HANOI))
    assert [event.line() for event in run.events] == [event.line() for event in headless.events]


def test_values_that_are_unknown_or_disagree_are_plain(sit: Sit) -> None:
    run = AtRun(sit(FAILURES))
    run.choose("table")
    run.person.click(run.pane.transport.by_hand)
    run.person.press(Key.Key_F5)
    run.until_phase("Ready")
    run.pane.run.inject("set", fact="REGISTRATION/1", value="e")
    run.person.until(lambda: _tiles(run)[1].quality == "differs")
    assert "badly" in _said(run)[1]
    run.pane.run.disturb("REGISTRATION/2", "dropout")
    run.person.until(lambda: _tiles(run)[2].quality == "unknown")
    assert _said(run)[2].startswith("Registered: unknown, ")
    person = run.person
    for theme in ("dark", "light"):
        person.windows.set_theme(theme)
        picture = _scene(run).tiles.grab().toImage()
        tokens = _scene(run).tiles.painter.tokens
        corner = _scene(run).tiles.visualRect(_scene(run).tiles.tiles.index(1)).center()
        ratio = picture.devicePixelRatio()
        colours = {
            picture.pixelColor(int(x * ratio), int((corner.y() - 30) * ratio)).name()
            for x in range(corner.x() - 60, corner.x() + 60)
        }
        assert tokens.bads.name() in colours


def test_arrow_keys_go_from_tile_to_tile_and_letters_stay_keys_of_the_window(sit: Sit) -> None:
    run = _plays(sit)
    run.until_phase("Goal reached")
    tiles = _scene(run).tiles
    tiles.setFocus(Qt.FocusReason.TabFocusReason)
    run.person.press(Key.Key_Home)
    run.person.press(Key.Key_Right)
    assert tiles.currentIndex().row() == 1
    QTest.keyClicks(tiles, "f")
    assert tiles.currentIndex().row() == 1


def test_no_tile_is_cut_at_the_sides_and_moving_ones_come_into_view(sit: Sit) -> None:
    run = _plays(sit, HANOI, size=(1280, 720))
    run.until_phase("Goal reached")
    tiles = _scene(run).tiles
    rects = [tiles.visualRect(tiles.tiles.index(at)) for at in range(3)]
    assert all(tiles.viewport().rect().contains(rect.adjusted(0, 0, -8, -8)) for rect in rects)


def test_the_look_changes_only_when_nothing_moves(
    sit: Sit, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(operation_time, "USUAL", LONG)
    run = _plays(sit)
    run.until_runs()
    windows, window = run.person.windows, run.person.window
    windows.set_theme("dark")
    assert window.tokens is LIGHT, "Qt hears no Stop while it dresses all widgets"
    assert "when the run pauses" in window.toast.words
    run.person.press(Key.Key_F8)
    run.until_phase("Stopped")
    run.person.until(lambda: window.tokens is DARK)
    windows.set_theme("light")
    assert window.tokens is LIGHT
