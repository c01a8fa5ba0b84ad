"""DockFold: folds the lower panel to its tabs, so that the drawing has more room."""

from __future__ import annotations

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtWidgets import QDockWidget, QMainWindow

from smsl_studio.studio.base.small_button import SmallButton
from smsl_studio.studio.base.tabs import HEIGHT, Tabs
from smsl_studio.studio.base.theme import Tokens

WORDS = {False: "Fold to the tabs", True: "Unfold"}
PICTURES = {False: "chevron-down", True: "chevron-up"}
ANY = 16_777_215
"""The greatest height that Qt allows."""


class DockFold(QObject):
    """Folds a dock to its tabs and unfolds it. A click on a tab unfolds it, too, and so does every
    command that shows one of its panels.
    """

    changed = Signal()

    def __init__(
        self, window: QMainWindow, dock: QDockWidget, tabs: Tabs, height: int, tokens: Tokens
    ) -> None:
        """``height`` is the height of the dock when it is unfolded for the first time (pixels)."""
        super().__init__(window)
        self._window, self._dock, self._tabs, self._height = window, dock, tabs, height
        self.folded = False
        self.button = SmallButton(WORDS[False], PICTURES[False], tokens)
        self.button.clicked.connect(self.toggle)
        tabs.add_button(self.button)
        tabs.bar.tabBarClicked.connect(lambda _: self.put(False))

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.button.set_tokens(tokens)

    def toggle(self) -> None:
        """Fold, or unfold."""
        self.put(not self.folded)

    def put(self, folded: bool) -> None:
        """Fold the dock to its tabs, or give it its former height."""
        if folded == self.folded:
            return
        self.folded = folded
        if folded:
            self._height = max(self._dock.height(), 2 * HEIGHT)
        self._tabs.show_pages(not folded)
        self._dock.setMinimumHeight(HEIGHT if folded else 0)
        self._dock.setMaximumHeight(HEIGHT if folded else ANY)
        if not folded:
            self._window.resizeDocks([self._dock], [self._height], Qt.Orientation.Vertical)
        self.button.show_as(WORDS[folded], PICTURES[folded])
        self.changed.emit()
