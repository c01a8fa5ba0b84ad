"""Feature: what a part of the window gives to the shell, and what it may ask of the shell."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Protocol, runtime_checkable

from PySide6.QtCore import QPoint, QRect
from PySide6.QtWidgets import QMenu, QWidget

from smsl_studio.library.loaded import Loaded
from smsl_studio.studio.base.actions import Action, Actions
from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.base.theme import Tokens

KeyList = tuple[str, tuple[tuple[str, str], ...]]
"""A title, and pairs (words, key) below it, for the list of shortcuts."""


Control = tuple[QWidget, QRect]
"""A widget, and the part of it that counts."""


def whole(widget: QWidget) -> Control:
    """A widget as a control."""
    return widget, widget.rect()


@dataclass(frozen=True)
class Page:
    """The body of a mode.

    ``focus`` gets the keyboard focus when the mode is shown. ``row`` fills the mode bar; None
    leaves the drawing tools there.
    """

    body: QWidget
    focus: QWidget
    row: QWidget | None = None


@dataclass(frozen=True)
class ModePage:
    """A further page of the mode Draw: ``words`` stand on its tab, ``make`` is called when it is
    first shown. The tab is there after ``Shell.show_page``."""

    id: str
    words: str
    make: Callable[[], Page]


@runtime_checkable
class Coloured(Protocol):
    """A widget that paints with colours of its own, and not with the palette alone."""

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""


@dataclass(frozen=True)
class DockPanel:
    """A panel beside the drawing: ``side`` is left, right or bottom; ``name`` is on its tab.

    Its colours change with the theme if the widget has a method ``set_tokens``. ``tools`` stand at
    the right end of the tabs. ``focus`` gets the keyboard focus, if it is not
    the panel itself. A ``tall`` panel at the bottom has more than half of the window. ``after`` is
    the panel on whose right its tab stands, if it is of another feature.
    """

    name: str
    side: str
    widget: QWidget
    tools: QWidget | None = None
    focus: QWidget | None = None
    tall: bool = False
    after: str = ""

    def __post_init__(self) -> None:
        """Write the name at the widget, so that help finds the panel around what has the focus."""
        self.widget.setProperty("panel", self.name)


class Feature:
    """One feature of a window, in the form that the shell knows. A subclass fills what it has.

    One object is made for each window. A feature does not know other features. The table of
    features in the shell hands it what it needs of them.
    """

    pages: Mapping[str, Callable[[], Page]] = MappingProxyType({})
    """The pages by mode. A page is made when its mode is shown for the first time."""
    mode_pages: tuple[ModePage, ...] = ()
    """Further pages of the mode Draw, for its row of pages."""
    panels: tuple[DockPanel, ...] = ()
    badges: tuple[QWidget, ...] = ()
    """Widgets at the right of the menu bar, visible in every mode."""
    submenus: Mapping[str, tuple[str, Callable[[QMenu], None]]] = MappingProxyType({})
    """Submenus by the id of the action above each: its words, and a function that fills it when
    it opens."""
    keys: tuple[KeyList, ...] = ()
    """Keys that are no actions, for the list of shortcuts."""

    def control(self, name: str) -> Control | None:
        """The control of this name, for somebody who points at it; None if there is none now."""
        return None

    def actions(self) -> tuple[Action, ...]:
        """The rows of this feature for the table of actions, in their order."""
        return ()

    def take_actions(self, actions: Actions) -> None:
        """Receive the complete table, with the actions of all features."""

    def set_plugins(self, loaded: Loaded, known: bool) -> None:
        """Receive what the installed plugins offer.

        ``known`` is False as long as they have not been searched for.
        """

    def open_path(self, path: Path) -> bool:
        """Open a file if it is of this feature's kind; False if it is not."""
        return False

    def settle(self) -> None:
        """Take over what is still being typed."""

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""

    def stop(self) -> None:
        """End all work, because the window closes."""


class AllWindows(Protocol):
    """What actions may ask of the program with all its windows."""

    settings: Settings

    @property
    def theme(self) -> str:
        """The name of the chosen theme."""

    def set_theme(self, theme: str) -> None:
        """Set the theme of all windows."""

    def set_calm(self, on: bool) -> None:
        """Let the views of all windows jump instead of gliding."""

    def set_wheel_scrolls(self, on: bool) -> None:
        """Let a mouse wheel scroll the drawings of all windows, or zoom."""

    def set_keys(self, action: str, keys: tuple[str, ...] | None) -> None:
        """Give an action other keys in all windows; None gives it its shipped keys back."""

    def set_plugin_folders(self, folders: tuple[str, ...]) -> None:
        """Search for plugins in these further folders, now and later."""

    def stop_every_run(self) -> None:
        """Stop the runs of all windows."""

    def look_for_plugins(self) -> None:
        """Search for installed plugins again, for all windows."""

    def quit(self) -> None:
        """Close all windows and end the program. If the user keeps one window, all stay open."""


class DockSides(Protocol):
    """What actions may ask of the docks beside the drawing."""

    def words(self, side: str) -> str:
        """The names of the panels at a side, in a row."""

    def left_shown(self) -> bool:
        """Whether the dock at the left is shown."""

    def right_shown(self) -> bool:
        """Whether the dock at the right is shown."""

    def bottom_shown(self) -> bool:
        """Whether the dock at the bottom is shown."""

    def bottom_folded(self) -> bool:
        """Whether the dock at the bottom shows only its tabs."""

    def toggle_left(self) -> None:
        """Show or hide the dock at the left."""

    def toggle_right(self) -> None:
        """Show or hide the dock at the right."""

    def toggle_bottom(self) -> None:
        """Show or hide the dock at the bottom."""

    def fold_bottom(self) -> None:
        """Fold the dock at the bottom to its tabs, or unfold it."""

    def enter_tab(self, name: str) -> bool:
        """Show the tab of this name and give it the keyboard focus.

        False if it has the focus already.
        """


class Shell(Protocol):
    """What a feature may ask of its window."""

    @property
    def mode(self) -> str:
        """The current mode, such as "draw"."""

    @property
    def sides(self) -> DockSides:
        """The docks beside the drawing."""

    @property
    def program(self) -> AllWindows:
        """The program with all its windows."""

    def set_mode(self, mode: str) -> None:
        """Switch to another mode."""

    def show_tab(self, name: str) -> None:
        """Bring the panel of this name to the front."""

    def show_count(self, panel: str, count: int) -> None:
        """Show a number on the tab of a panel."""

    def show_page(self, page: str, count: int | None) -> None:
        """Offer a page of Draw in the row of pages, with a number; None takes it away."""

    def hold_run(self, reason: str) -> None:
        """Let Run wait, for a reason in words; empty text lets it go on."""

    def show_segment(self, name: str, shown: bool) -> None:
        """Show or hide the button of a mode in the mode bar."""

    def add_badge(self, badge: QWidget) -> None:
        """Add a badge at the right of the menu bar, for a feature that made it late."""

    def say_findings(self, words: str) -> None:
        """Show the number of findings in the status line."""

    def corner_below(self, action: str) -> QPoint:
        """The point of the screen below the button of an action, for a menu."""

    def controls(self, name: str) -> list[Control]:
        """The controls of this name in all features and bars, visible or not."""

    def new_window(self) -> None:
        """Open another window."""

    def copy_beside(self, path: Path) -> None:
        """Open a copy of a sample in another window."""

    def open_palette(self) -> None:
        """Open the command palette."""

    def show_shortcuts(self) -> None:
        """Show the list of all shortcuts."""

    def has_failure(self) -> bool:
        """Whether the program failed since its start."""

    def show_failure(self) -> None:
        """Show the report of the last failure."""

    def show_about(self) -> None:
        """Show the name of the program and its version."""
