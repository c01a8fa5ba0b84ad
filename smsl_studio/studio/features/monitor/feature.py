"""The monitor as a feature: a page of Run, and beside Supervise a window of its own."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QWidget

from smsl_studio.blueprint.check import FactKey
from smsl_studio.studio.base.feature import Feature, Shell
from smsl_studio.studio.base.late_part import LatePart
from smsl_studio.studio.base.theme import Tokens

if TYPE_CHECKING:
    from smsl_studio.studio.base.headed_page import HeadedPage
    from smsl_studio.studio.features.monitor.opener import MonitorOpener
    from smsl_studio.studio.features.monitor.pages import MonitorPages
    from smsl_studio.studio.running.run_session import RunSession

NAME = "Monitor"
APART = ("supervise", "replay")
"""The modes that stay in view while the monitor is open."""


class MonitorFeature(Feature):
    """The page with every sensor and node of the run.

    ``run`` returns the run of the window, and the widget in front of which a window of its own
    opens. ``room`` makes the page of the room.
    """

    def __init__(
        self,
        run: Callable[[], tuple[RunSession, QWidget]],
        tokens: Tokens,
        shell: Shell,
        room: Callable[[], HeadedPage],
    ) -> None:
        self._run, self._tokens, self._shell, self._room = run, tokens, shell, room
        self.toggle_page: Callable[[str], None] = lambda name: None
        """Shows a page of Run by its name; if it is shown, the run itself."""
        self.show_page: Callable[[str], None] = lambda name: None
        """Shows a page of Run by its name."""
        self.part = LatePart(self._make)
        self.inside = LatePart(self._make_pages)
        """What stands in Run: the sensors, and the room."""

    @property
    def opener(self) -> MonitorOpener:
        """The object that opens and keeps the window of its own."""
        return self.part()

    def _make(self) -> MonitorOpener:
        from smsl_studio.studio.features.monitor.opener import MonitorOpener

        run, parent = self._run()
        return MonitorOpener(run, self._tokens, parent)

    def _make_pages(self) -> MonitorPages:
        from smsl_studio.studio.features.monitor.page import MonitorPage
        from smsl_studio.studio.features.monitor.pages import MonitorPages

        run, _ = self._run()
        pages = MonitorPages(MonitorPage(run, self._tokens), self._room)
        pages.sensors.apart.clicked.connect(lambda: self.opener.show())
        pages.offer_room(run.remote() is not None)
        run.changed.connect(lambda: pages.offer_room(run.remote() is not None))
        return pages

    def toggle(self) -> None:
        """Show the monitor; leave it if it is in front already. Supervise stays in view."""
        if self._shell.mode in APART:
            self.opener.toggle()
        else:
            self.toggle_page(NAME)

    def show_fact(self, fact: FactKey) -> None:
        """Show what the sources of a fact measure."""
        if self._shell.mode in APART:
            self.opener.show()
            window = self.opener.window
            assert window is not None
            window.page.choose_fact(fact)
        else:
            self.show_sensors()
            self.inside().sensors.choose_fact(fact)

    def show_sensors(self) -> None:
        """Show every sensor in Run, where each can be disturbed."""
        from smsl_studio.studio.features.monitor.pages import SENSORS

        self.show_page(NAME)
        self.inside().show_page(SENSORS)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        if self.part.made is not None:
            self.part.made.set_tokens(tokens)
        if self.inside.made is not None:
            self.inside.made.sensors.set_tokens(tokens)

    def stop(self) -> None:
        """Close the window of its own, because its window closes."""
        if self.part.made is not None:
            self.part.made.close()
