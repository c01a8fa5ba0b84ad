"""The start page: what stands in a window before anything is open in it."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest
from PySide6.QtCore import QPoint, QRect, Qt
from PySide6.QtGui import QDesktopServices
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QWidget

from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.base.theme import DARK
from smsl_studio.studio.document.files.dialogs import Dialogs
from smsl_studio.studio.features.help.pages import HelpPlace
from smsl_studio.studio.features.start.page import StartPage
from smsl_studio.studio.features.start.recent import RecentRow
from smsl_studio.studio.features.start.tile import Tile
from smsl_studio.studio.shell.window import Window
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key = Qt.Key
TOOLS = ("undo", "redo", "add_state", "connect", "sub_sb", "tidy")


def page_of(window: Window) -> StartPage:
    page = window.features.start.part.made
    assert page is not None
    return page


def copies(folder: Path, *names: str) -> list[Path]:
    folder.mkdir(exist_ok=True)
    return [Path(shutil.copy(SAMPLES / name, folder / name)) for name in names]


def row_of(person: Person, name: str) -> RecentRow:
    rows = page_of(person.window).column.rows
    return next(row for row in rows if row.path.name == name)


def box(tile: QWidget) -> QRect:
    return QRect(tile.mapToGlobal(QPoint(0, 0)), tile.size())


@pytest.fixture
def remembered(home: Path, tmp_path: Path) -> list[Path]:
    """Six files that were open before, the last one last."""
    names = ("hfsm.json", "hanoi-2.json", "registration.json", "three-roots.json",
             "hanoi-corrected.json", "example.smsl")  # fmt: skip
    paths = copies(tmp_path / "procedures", *names)
    settings = Settings(home)
    for path in paths:
        settings.remember(path)
    settings.sync()
    return paths


def test_a_window_without_a_file_says_what_can_be_done_and_nothing_else(sit: Sit) -> None:
    person = sit(begin=False)
    window = person.window
    page = page_of(window)
    assert (window.mode, page.isVisible()) == ("start", True)
    assert page.column.cards[0].hasFocus()
    person.until_inspected()
    assert window.status_line.words == "No file open"
    assert (window.menu_row.title, window.windowTitle()) == ("SMSL Studio", "SMSL Studio")
    assert not window.features.approval.badge.isVisible()
    docks = (window.docks.left, window.docks.right, window.docks.bottom)
    assert not any(dock.isVisible() for dock in docks)
    assert not window.mode_bar.run.isEnabled()
    assert window.mode_bar.search.isVisible()
    assert window.actions_table["mode_draw"].isChecked()
    off = (*TOOLS, "run_play", "run_step", "save", "save_as", "show_source", "left_panel")
    assert [name for name in off if window.actions_table[name].isEnabled()] == []


@pytest.mark.parametrize("how", ["enter", "space", "click", "key"])
def test_the_first_card_gives_an_empty_canvas(sit: Sit, how: str) -> None:
    person = sit(begin=False)
    window = person.window
    if how == "key":
        person.ctrl(Key.Key_N)
    elif how == "click":
        person.click(page_of(window).column.cards[0])
    else:
        person.press(Key.Key_Return if how == "enter" else Key.Key_Space)
    assert (window.mode, window.canvas.hasFocus()) == ("draw", True)
    docks = window.docks
    assert [d.isVisible() for d in (docks.left, docks.right, docks.bottom)] == [True] * 3
    assert (docks.left.width(), docks.right.width()) == (232, 304)
    assert window.mode_bar.run.isEnabled()
    assert window.menu_row.title == "untitled.json"
    person.double_click_canvas(window.canvas.rect().center())
    person.press(Key.Key_Return)
    assert person.blueprint.state_count == 1


def test_the_second_card_asks_for_a_file(
    sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (path,) = copies(tmp_path / "here", "hfsm.json")
    monkeypatch.setattr(Dialogs, "file_to_open", lambda *_: None)
    person = sit(begin=False)
    person.press(Key.Key_Right)
    person.press(Key.Key_Return)
    assert person.window.mode == "start", "nothing was chosen"
    monkeypatch.setattr(Dialogs, "file_to_open", lambda *_: path)
    person.press(Key.Key_Return)
    assert (person.window.mode, person.window.menu_row.title) == ("draw", "hfsm.json")


def test_try_it_begins_the_tour(sit: Sit) -> None:
    person = sit(begin=False)
    window = person.window
    person.click(page_of(window).column.cards[2])
    assert (window.menu_row.title, window.files.path) == ("hanoi.json", None)
    assert window.features.tour.tour is not None


def test_a_sample_opens_as_a_copy_and_has_its_picture(sit: Sit) -> None:
    person = sit(begin=False)
    column = page_of(person.window).column
    assert len(column.samples) == 5
    person.until(lambda: all(card.miniature is not None for card in column.samples))
    card = column.samples[0]
    assert card.miniature is not None
    assert len(card.miniature.places) == 27
    before = card.path.read_bytes()
    person.click(card)
    assert (person.window.mode, person.window.files.path) == ("draw", None)
    assert person.blueprint.state_count == 27
    assert card.path.read_bytes() == before
    assert person.window.features.approval.badge.isVisible()


def test_recent_files_have_pictures_and_open_with_a_click(sit: Sit, remembered: list[Path]) -> None:
    person = sit(begin=False)
    column = page_of(person.window).column
    shown = [row.path for row in column.rows if row.isVisible()]
    assert shown == remembered[:1:-1], "the newest first, four of six"
    person.until(lambda: all(row.found.miniature is not None for row in column.rows))
    assert "Opened today" in column.rows[0].accessibleDescription()
    assert column.show_all.text() == "Show all 6"
    person.click(column.show_all)
    assert all(row.isVisible() for row in column.rows)
    assert not column.show_all.isVisible()
    assert column.rows[4].hasFocus()
    person.press(Key.Key_Down)
    person.press(Key.Key_Return)
    assert person.window.files.path == remembered[0]
    assert person.window.mode == "draw"


def test_a_file_that_is_gone_says_so_and_can_be_removed(sit: Sit, remembered: list[Path]) -> None:
    gone = remembered[-1]
    gone.unlink()
    person = sit(begin=False)
    row = row_of(person, gone.name)
    person.until(lambda: not row.found.exists)
    assert row.last_line == "Not found"
    assert "Not found" in row.accessibleDescription()
    person.click(row.remove)
    column = page_of(person.window).column
    assert gone not in [row.path for row in column.rows]
    assert gone not in person.windows.settings.recent
    assert person.window.mode == "start"
    assert column.current is not None, "the keys stay on the page"


def test_a_file_that_does_not_open_leaves_the_page_and_says_why(
    sit: Sit, remembered: list[Path]
) -> None:
    person = sit(begin=False)
    remembered[-1].unlink()
    person.click(row_of(person, remembered[-1].name))
    assert person.window.mode == "start"
    assert remembered[-1].name in person.window.toast.words
    assert remembered[-1] not in [row.path for row in page_of(person.window).column.rows]


def test_hostile_recent_files_have_a_neutral_picture(sit: Sit, home: Path, tmp_path: Path) -> None:
    broken, binary, pipe, folder = (tmp_path / f"{name}.json" for name in "abcd")
    broken.write_text('{"SB1": {"State0": ' * 500)
    binary.write_bytes(b"\x00\xff" * 4000)
    os.mkfifo(pipe)
    folder.mkdir()
    huge, last = tmp_path / "huge.json", tmp_path / "last.json"
    with huge.open("wb") as file:
        file.truncate(1 << 40)
    shutil.copy(SAMPLES / "hfsm.json", last)
    settings = Settings(home)
    for path in (last, huge, folder, pipe, binary, broken):
        settings.remember(path)
    settings.sync()
    person = sit(begin=False)
    column = page_of(person.window).column
    person.until(lambda: column.rows[-1].found.miniature is not None)
    assert all(row.found.exists for row in column.rows)
    assert [row.found.miniature for row in column.rows[:-1]] == [None] * 5


def test_arrows_reach_every_tile_and_never_leave_the_page(sit: Sit, remembered: list[Path]) -> None:
    person = sit(begin=False)
    column = page_of(person.window).column
    person.click(column.show_all)
    seen: set[Tile] = set()
    column.cards[0].setFocus()
    waiting: list[Tile] = [column.cards[0]]
    while waiting:
        tile = waiting.pop()
        for key in (Key.Key_Left, Key.Key_Right, Key.Key_Up, Key.Key_Down):
            tile.setFocus()
            person.press(key)
            there = column.current
            assert there is not None
            if there not in seen:
                seen.add(there)
                waiting.append(there)
    assert seen == set(column.tiles)
    column.cards[0].setFocus()
    person.press(Key.Key_Right)
    person.press(Key.Key_Right)
    assert column.cards[2].hasFocus()
    person.press(Key.Key_Down)
    assert column.samples[2].hasFocus(), "what stands below"


@pytest.mark.parametrize("size", [(1440, 900), (1280, 800), (1100, 700), (900, 560)])
def test_nothing_lies_on_anything_else(
    sit: Sit, remembered: list[Path], size: tuple[int, int]
) -> None:
    person = sit(begin=False, size=size)
    page = page_of(person.window)
    column = page.column
    person.until(lambda: page.width() == size[0])
    tiles = [tile for tile in column.tiles if tile.isVisible()]
    boxes = [box(tile) for tile in tiles]
    for at, one in enumerate(boxes):
        assert not any(one.intersects(other) for other in boxes[:at])
    whole = box(column)
    assert all(whole.contains(one) for one in boxes)
    under = box(column.samples[0]).top() > box(column.rows[3]).bottom()
    assert under == (size[0] < 1180)
    column.links.tiles[-1].setFocus()
    person.press(Key.Key_Up)
    assert column.current is not None
    assert box(page.viewport()).contains(box(column.current)), "what has the focus is in view"


def test_without_recent_files_the_samples_take_the_whole_width(sit: Sit) -> None:
    column = page_of(sit(begin=False).window).column
    assert not column.rows
    assert box(column.samples[0]).left() == box(column.cards[0]).left()
    assert box(column.samples[3]).right() == box(column.cards[2]).right()


def test_the_page_comes_back_with_draw_until_something_is_open(sit: Sit) -> None:
    person = sit(begin=False)
    person.ctrl(Key.Key_2)
    assert person.window.mode == "run"
    person.ctrl(Key.Key_1)
    assert person.window.mode == "start"
    assert page_of(person.window).column.cards[0].hasFocus()
    person.ctrl(Key.Key_N)
    person.ctrl(Key.Key_2)
    person.ctrl(Key.Key_1)
    assert person.window.mode == "draw"


def test_another_window_has_its_own_page_that_knows_what_was_opened_since(
    sit: Sit, tmp_path: Path
) -> None:
    (path,) = copies(tmp_path / "here", "hfsm.json")
    first = sit(begin=False)
    first.window.new_window()
    (second,) = (one for one in first.windows if one is not first.window)
    assert isinstance(second, Window)
    assert second.mode == "start"
    second.open_path(path)
    assert second.mode == "draw"
    first.window.activateWindow()
    first.until(lambda: [row.path for row in page_of(first.window).column.rows] == [path])


def test_a_file_named_at_the_start_never_shows_the_page(sit: Sit, tmp_path: Path) -> None:
    (path,) = copies(tmp_path / "here", "hfsm.json")
    person = sit(path)
    assert person.window.mode == "draw"
    assert person.window.features.start.part.made is None


def test_the_page_follows_the_theme(sit: Sit, remembered: list[Path]) -> None:
    person = sit(begin=False)
    person.windows.set_theme("dark")
    column = page_of(person.window).column
    assert all(tile.tokens == DARK for tile in column.tiles)
    ground = column.grab().toImage().pixelColor(2, 2)
    assert ground.name() == DARK.canvas.name()


def test_the_link_shows_the_folder_of_the_samples(
    sit: Sit, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[str] = []
    monkeypatch.setattr(QDesktopServices, "openUrl", lambda url: asked.append(url.toLocalFile()))
    person = sit(begin=False)
    person.click(page_of(person.window).column.links.folder)
    assert asked == [str(SAMPLES)]


def test_a_link_leads_to_the_page_for_engineers(sit: Sit) -> None:
    person = sit(begin=False)
    person.click(page_of(person.window).column.links.help)
    (window,) = person.window.features.help.windows
    assert window.page.place == HelpPlace("engineer.md")
    window.close()


def test_a_name_is_shown_as_it_is(sit: Sit, home: Path, tmp_path: Path) -> None:
    path = tmp_path / "<b>bold&\u202e.json"
    shutil.copy(SAMPLES / "hfsm.json", path)
    Settings(home).remember(path)
    person = sit(begin=False)
    (row,) = page_of(person.window).column.rows
    assert row.accessibleName() == "<b>bold&\\u202e.json"
    QTest.mouseClick(row, Qt.MouseButton.LeftButton)
    QApplication.processEvents()
    assert person.window.files.path == path
