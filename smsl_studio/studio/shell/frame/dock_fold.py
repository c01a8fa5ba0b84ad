"""DockFold: the height of the lower panel. In a low window it is low, so that the drawing has the
room, and it can be folded to its tabs.
"""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, Qt, Signal
from PySide6.QtWidgets import QDockWidget, QMainWindow

from smsl_studio.studio.base.small_button import SmallButton
from smsl_studio.studio.base.tabs import HEIGHT, Tabs
from smsl_studio.studio.base.theme import Tokens

WORDS = {False: "Fold to the tabs", True: "Unfold"}
PICTURES = {False: "chevron-down", True: "chevron-up"}
ANY = 16_777_215
"""The greatest height that Qt allows."""
LEAST, MOST = 112, 196
"""The heights of the panel in a low and in a high window (pixels)."""
LOW_WINDOW, HIGH_WINDOW = 640, 800
"""The heights of the windows in which it has them (pixels)."""


def usual_height(window: int) -> int:
    """The height of the panel in a window of this height, if no person has chosen one (pixels)."""
    share = (window - LOW_WINDOW) / (HIGH_WINDOW - LOW_WINDOW)
    return LEAST + round((MOST - LEAST) * max(0.0, min(share, 1.0)))


TALL, AT_LEAST = 0.558, 0.45
"""The height of a tall panel, as a share of the window: at most the first number, and at least the
second one even if the drawing gets little space."""
DRAWING = 394
"""The height that the drawing and the bars of the window need above a tall panel (pixels). It
leaves 280 pixels for the drawing, so that its names can be read."""


def tall_height(window: int) -> int:
    """The usual height of a tall panel in a window of this height (both in pixels)."""
    room = min(round(TALL * window), window - DRAWING)
    return max(room, round(AT_LEAST * window), usual_height(window))


class DockFold(QObject):
    """Folds a dock to its tabs, and unfolds it.

    A click on a tab also unfolds it. So does every command that shows one of its panels. ``own`` is
    the height that a person has given the dock by dragging its edge (pixels). It is 0 if the height
    follows that of the window. ``own_tall`` is the same for tall panels.
    """

    changed = Signal()

    def __init__(self, window: QMainWindow, dock: QDockWidget, tabs: Tabs, tokens: Tokens) -> None:
        super().__init__(window)
        self._window, self._dock, self._tabs = window, dock, tabs
        self.folded = self._tall = False
        self._pointed = False
        """Whether a tab was pressed and the pointer is still on the tabs."""
        self.own = self.own_tall = self._before = 0
        self.button = SmallButton(WORDS[False], PICTURES[False], tokens)
        self.button.clicked.connect(self.toggle)
        tabs.add_button(self.button)
        tabs.bar.tabBarClicked.connect(lambda _: self._press_tab())
        tabs.bar.installEventFilter(self)
        window.installEventFilter(self)

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
        self._tabs.show_pages(not folded)
        self._dock.setMinimumHeight(HEIGHT if folded else 0)
        self._dock.setMaximumHeight(HEIGHT if folded else ANY)
        self.fit()
        self.button.show_as(WORDS[folded], PICTURES[folded])
        self.changed.emit()

    def put_tall(self, tall: bool) -> None:
        """Give the dock the height of a tall panel, or of a usual one.

        While the pointer is on the tabs they stay below it: the height changes when it leaves them.
        """
        if tall != self._tall:
            self._tall = tall
            if not self._pointed:
                self.fit()

    def _press_tab(self) -> None:
        self.put(False)
        self._pointed = True

    @property
    def _height(self) -> int:
        """The height for the panel that is shown (pixels)."""
        window = self._window.height()
        if self._tall:
            return self.own_tall or tall_height(window)
        return self.own or usual_height(window)

    def fit(self) -> None:
        """Give the dock the height that it has in a window of this height, unless it is folded."""
        if not self.folded:
            self._window.resizeDocks([self._dock], [self._height], Qt.Orientation.Vertical)
            # At once: the drawing must not move later, when somebody works on it already.
            layout = self._window.layout()
            if layout is not None and self._window.isVisible():
                layout.activate()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Note the height that a person gives the dock. Only the edges of docks get a press of the
        pointer from the window itself."""
        if watched is self._tabs.bar:
            if event.type() == QEvent.Type.Leave and self._pointed:
                self._pointed = False
                self.fit()
        elif event.type() == QEvent.Type.MouseButtonPress:
            self._before = self._dock.height()
        elif event.type() == QEvent.Type.MouseButtonRelease and not self.folded:
            height = self._dock.height()
            if height != self._before and self._tall:
                self.own_tall = height
            elif height != self._before:
                self.own = height
        return super().eventFilter(watched, event)
