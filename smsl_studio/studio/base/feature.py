"""Feature: what a part of the window hands to its shell, and what it may ask of the shell."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Protocol

from PySide6.QtCore import QPoint
from PySide6.QtWidgets import QMenu, QWidget

from smsl_studio.library.loaded import Loaded
from smsl_studio.studio.base.actions import Action, Actions
from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.base.theme import Tokens

KeyList = tuple[str, tuple[tuple[str, str], ...]]
"""A title, and below it words and key of each."""


@dataclass(frozen=True)
class Page:
    """The body of a mode, what takes the keys in it, and its row of the mode bar (None: tools)."""

    body: QWidget
    focus: QWidget
    row: QWidget | None = None


@dataclass(frozen=True)
class DockPanel:
    """A panel beside the drawing: ``left``, ``right`` or ``bottom``, with a name on its tab.

    ``tools`` stand at the end of its tabs, and ``focus`` takes the keys where it is not the panel.
    """

    name: str
    side: str
    widget: QWidget
    tools: QWidget | None = None
    focus: QWidget | None = None


class Feature:
    """One thing that a window can do, as its shell knows it; what it does not have stays empty.

    Made once for each window. A feature knows none of its neighbours: what it needs of one is
    handed to it where the shell lists them all.
    """

    pages: Mapping[str, Callable[[], Page]] = MappingProxyType({})
    """What it shows, by mode; each page is made when its mode is first shown."""
    panels: tuple[DockPanel, ...] = ()
    badges: tuple[QWidget, ...] = ()
    """What it shows at the right of the menus in every mode."""
    submenus: Mapping[str, tuple[str, Callable[[QMenu], None]]] = MappingProxyType({})
    """By the action that each stands below: its words, and what fills it when it opens."""
    keys: tuple[KeyList, ...] = ()
    """Keys of its own for the list of shortcuts."""

    def actions(self) -> tuple[Action, ...]:
        """Its rows of the table of actions, in their order."""
        return ()

    def take_actions(self, actions: Actions) -> None:
        """The whole table is there, with what every other feature put into it."""

    def set_plugins(self, loaded: Loaded, known: bool) -> None:
        """What the installed plugins offer; ``known`` says whether they were looked for at all."""

    def open_path(self, path: Path) -> bool:
        """Show a file that is of its kind; False where it is not."""
        return False

    def settle(self) -> None:
        """What is still being typed counts."""

    def set_tokens(self, tokens: Tokens) -> None:
        """Take other colours."""

    def stop(self) -> None:
        """The window goes away: nothing is worked at any more."""


class AllWindows(Protocol):
    """What actions ask of the program, whichever window they are asked in."""

    settings: Settings

    @property
    def theme(self) -> str:
        """The name of the chosen theme."""

    def set_theme(self, theme: str) -> None:
        """Put all windows into another theme."""

    def stop_every_run(self) -> None:
        """Stop the runs of all windows."""

    def look_for_plugins(self) -> None:
        """Look at the installed plugins again, for all windows."""

    def quit(self) -> None:
        """Close all windows and end the program; where one shall stay, all stay."""


class DockSides(Protocol):
    """What actions ask of the docks at the sides of the drawing."""

    def left_shown(self) -> bool:
        """Whether the dock at the left is shown."""

    def right_shown(self) -> bool:
        """Whether the dock at the right is shown."""

    def bottom_shown(self) -> bool:
        """Whether the dock at the bottom is shown."""

    def toggle_left(self) -> None:
        """Show or hide the dock at the left."""

    def toggle_right(self) -> None:
        """Show or hide the dock at the right."""

    def toggle_bottom(self) -> None:
        """Show or hide the dock at the bottom."""

    def enter_tab(self, name: str) -> bool:
        """Show the tab of this name and give it the keys; False where it has them already."""


class Shell(Protocol):
    """What a feature asks of the window that it is in."""

    @property
    def mode(self) -> str:
        """The mode that is shown, such as "draw"."""

    @property
    def sides(self) -> DockSides:
        """The docks at the sides of the drawing."""

    @property
    def program(self) -> AllWindows:
        """The program with all its windows."""

    def set_mode(self, mode: str) -> None:
        """Show another mode."""

    def show_tab(self, name: str) -> None:
        """Bring the panel of this name to the front."""

    def show_count(self, panel: str, count: int) -> None:
        """Say on the tab of a panel how much is in it."""

    def show_segment(self, name: str, shown: bool) -> None:
        """Offer a mode in the mode bar, or no longer."""

    def add_badge(self, badge: QWidget) -> None:
        """Show a badge of a feature that was made late, at the right of the menus."""

    def say_findings(self, words: str) -> None:
        """Say in the status line what was found."""

    def corner_below(self, action: str) -> QPoint:
        """A point of the screen below the button of an action."""

    def new_window(self) -> None:
        """Open another window."""

    def open_palette(self) -> None:
        """Open the box that finds anything."""

    def show_shortcuts(self) -> None:
        """Show the list of all shortcuts."""

    def show_about(self) -> None:
        """Show what this program is, and its version."""
