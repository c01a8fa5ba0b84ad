"""A feature gives the window its parts in one object, and is told of the window's events."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import QEvent
from PySide6.QtWidgets import QApplication, QMenu, QWidget
from pytestqt.qtbot import QtBot

from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.feature import DockPanel, Feature
from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.base.theme import DARK, Tokens
from smsl_studio.studio.shell import application as app
from smsl_studio.studio.shell.features import Features
from smsl_studio.studio.shell.frame.key_table import KeyTable
from smsl_studio.studio.shell.window import Window
from smsl_studio.studio.shell.windows import Windows


class Notes(Feature):
    """A feature that the window has never heard of."""

    keys = (("In the notes", (("Add a note", "N"),)),)

    def __init__(self) -> None:
        self.told: list[str] = []
        self.panels = (DockPanel("Notes", "bottom", QWidget()),)
        self.badges = (QWidget(),)
        self.submenus = {"note": ("Recent notes", self.fill)}

    def fill(self, menu: QMenu) -> None:
        menu.clear()
        menu.addAction("The note of today")

    def actions(self) -> tuple[Action, ...]:
        return (Action("note", "Add note", lambda: self.told.append("note"), "Edit"),)

    def open_path(self, path: Path) -> bool:
        self.told.append(path.name)
        return path.suffix == ".note"

    def settle(self) -> None:
        self.told.append("settled")

    def set_tokens(self, tokens: Tokens) -> None:
        self.told.append("dark" if tokens == DARK else "light")


@pytest.fixture
def notes(monkeypatch: pytest.MonkeyPatch) -> Notes:
    found, before = Notes(), Features.__iter__

    def with_notes(self: Features) -> Iterator[Feature]:
        yield found
        yield from before(self)

    monkeypatch.setattr(Features, "__iter__", with_notes)
    return found


@pytest.fixture
def window(qapp: QApplication, qtbot: QtBot, notes: Notes) -> Iterator[Window]:
    shown = app.make_window(Windows(qapp, Settings()))
    yield shown
    shown.close()
    shown.deleteLater()
    qapp.sendPostedEvents(None, QEvent.Type.DeferredDelete)


def test_what_a_feature_hands_over_is_shown(window: Window, notes: Notes) -> None:
    assert "Notes" in window.docks.bottom_tabs.names
    assert window.menu_row.isAncestorOf(notes.badges[0])
    window.actions_table["note"].trigger()
    assert notes.told[-2:] == ["settled", "note"], "what is typed counts before anything is done"
    menus = {menu.title() for menu in window.menu_row.menus.findChildren(QMenu)}
    assert "Recent notes" in menus
    window.show_shortcuts()
    (dialog,) = (one for one in window.children() if one.isWidgetType() and _is_keys(one))
    table = dialog.findChild(KeyTable)
    assert table is not None
    assert "Add a note" in table.words


def test_a_feature_is_asked_first_about_a_file_and_told_of_colours(
    window: Window, notes: Notes, tmp_path: Path
) -> None:
    before = window.files.path
    window.open_path(tmp_path / "today.note")
    assert (notes.told[-1], window.files.path) == ("today.note", before)
    window.wear(DARK)
    assert notes.told[-1] == "dark"


def test_every_mode_panel_and_action_comes_from_one_feature(window: Window) -> None:
    features = list(window.features)
    modes = [mode for feature in features for mode in feature.pages]
    panels = [panel.name for feature in features for panel in feature.panels]
    actions = [action.id for feature in features for action in feature.actions()]
    assert set(modes) == {"start", "draw", "run", "supervise", "review", "replay"}
    for names in (modes, panels, actions):
        assert max(Counter(names).values()) == 1
    assert set(actions) < set(window.actions_table.table)


def test_the_page_has_a_row_for_every_panel(window: Window) -> None:
    page = (Path(__file__).parents[3] / "docs" / "window.md").read_text("utf-8")
    drawn = [panel.name for panel in window.docks.panels if panel.name != "Notes"]
    assert [name for name in drawn if f"\n| {name} | " not in page] == []


def _is_keys(child: object) -> bool:
    return isinstance(child, QWidget) and child.windowTitle() == "Keyboard shortcuts"


def _words(widget: QWidget) -> str:
    return str(widget.property("text") or "")
