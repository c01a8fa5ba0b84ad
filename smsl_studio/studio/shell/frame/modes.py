"""The modes of a window: the page, the row of the mode bar, and the keyboard focus of each."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping

from PySide6.QtCore import QCoreApplication, QEvent, QSize
from PySide6.QtWidgets import QWidget

from smsl_studio.studio.base.feature import Page
from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.shell.frame.body import PageBody
from smsl_studio.studio.shell.frame.docks import Docks
from smsl_studio.studio.shell.frame.mode_bar import ModeBar
from smsl_studio.studio.shell.frame.status_line import StatusLine

DRAW = "draw"
FOLD, OWN, OWN_TALL = "panels/fold", "panels/lower", "panels/tall"
"""The keys of three settings: whether the lower panel is folded, and the heights that a person gave
it. The second height is for tall pages, such as Inspection."""
OWN_HEIGHT = re.compile("[1-9][0-9]{1,3}")
"""How a height stands in the settings (pixels)."""


class Modes:
    """Shows one mode at a time. Only Draw has docks, and their places are remembered.

    ``pages`` make the page of each mode when it is shown for the first time.
    """

    def __init__(
        self,
        pages: Mapping[str, Callable[[], Page]],
        body: PageBody,
        docks: Docks,
        settings: Settings,
    ) -> None:
        self._make, self._body = pages, body
        self._docks, self._settings = docks, settings
        self._pages = {DRAW: pages[DRAW]()}
        self.shown = DRAW
        body.add_page(self._pages[DRAW].body)

    def dress(self, bar: ModeBar, line: StatusLine) -> None:
        """Set the bars that follow the mode."""
        self._bar, self._line = bar, line

    def _page(self, name: str) -> Page:
        page = self._pages.get(name)
        if page is None:
            page = self._pages[name] = self._make[name]()
            self._body.add_page(page.body)
            if page.row is not None:
                self._bar.add_row(name, page.row)
        return page

    def show(self, name: str, size: QSize) -> None:
        """Show another mode; ``size`` is the size of the window (pixels)."""
        self.keep()
        page, self.shown = self._page(name), name
        self._body.show_page(page.body)
        self._bar.show_mode(name)
        self._line.show_mode(name)
        self._docks.show_mode(name)
        if name == DRAW:
            self.restore()
        self.fit(size)
        self._bar.show()
        # Layouts follow a moment later by themselves. Until then the new page would be painted in
        # the room of the drawing.
        QCoreApplication.sendPostedEvents(None, QEvent.Type.LayoutRequest.value)
        # The widget with the focus may be hidden now, and Qt would give the focus to any other.
        self.take_focus()

    @property
    def home(self) -> QWidget:
        """The widget that takes the keys in the present mode."""
        return self._pages[self.shown].focus

    def take_focus(self) -> None:
        """Give the keyboard focus to the widget that takes the keys in the present mode."""
        self.home.setFocus()

    def restore(self) -> None:
        """Restore the places of the panels from the last window."""
        fold = self._docks.fold
        fold.own, fold.own_tall = self._height(OWN), self._height(OWN_TALL)
        fold.put(bool(self._settings.text_of(FOLD)))
        if not self._docks.restore(self._settings.bytes_of("panels/draw")):
            self._docks.set_first_sizes()

    def keep(self) -> None:
        """Remember the places of the panels, if they are shown."""
        if self.shown == DRAW and self._body.isVisible():
            self._settings.store("panels/draw", self._docks.save())
            fold = self._docks.fold
            self._settings.store_text(FOLD, "folded" if fold.folded else "")
            self._settings.store_text(OWN, str(fold.own or ""))
            self._settings.store_text(OWN_TALL, str(fold.own_tall or ""))

    def _height(self, setting: str) -> int:
        """A remembered height (pixels); 0 if there is none."""
        own = self._settings.text_of(setting)
        return int(own) if OWN_HEIGHT.fullmatch(own) else 0

    def fit(self, size: QSize) -> None:
        """In a narrow window show a drawer and its button instead of the left dock.

        In a low one hide the bottom dock.
        """
        narrow = self.shown == DRAW and self._docks.fit_width(size.width())
        if self.shown == DRAW:
            self._docks.fit_height(size.height())
        self._bar.left_button.setVisible(narrow)
