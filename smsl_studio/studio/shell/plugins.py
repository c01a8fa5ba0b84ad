"""What the installed plugins offer, shared by all windows.

Their code never runs in this process.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QTimer, Signal

from smsl_studio.errors import HostError
from smsl_studio.library.loaded import Loaded, PluginFault
from smsl_studio.studio.base.beside import Beside

if TYPE_CHECKING:
    from smsl_studio.library.survey import FoundPlugin

SOON = 150
"""Milliseconds from the first window to the search for plugins, so that the window is drawn
first."""


def described() -> Loaded:
    """What the plugins offer. The needed modules are imported only here."""
    from smsl_studio.host.plugin_offers import describe

    return describe()


class Plugins(QObject):
    """The plugins found last; ``look`` searches for them in a second thread.

    ``known`` says whether a search has ended. A run always loads its plugins anew, in its own
    process. This search is only for what the window offers.
    """

    changed = Signal()

    def __init__(self, look: Callable[[], Loaded] = described) -> None:
        super().__init__()
        self.loaded, self.known, self.looking = Loaded(), False, False
        self.news = ""
        """A sentence about the result of a repeated search; empty after the first one."""
        self._look = look
        self._asked: set[tuple[str, str]] = set()
        self._once_more = False
        self._beside: Beside | None = None
        self._soon = QTimer(self)
        self._soon.setSingleShot(True)
        self._soon.setInterval(SOON)
        self._soon.timeout.connect(self.look)

    def look_soon(self) -> None:
        """Search after the window is drawn, unless a search was made or is in progress."""
        if not self.known and not self.looking:
            # The wait begins when the event loop has nothing else to do.
            QTimer.singleShot(0, self._soon, self._soon.start)

    def look(self) -> None:
        """Search again; ``changed`` is emitted at the end.

        A call during a search makes another search after it, because something may have changed
        meanwhile.
        """
        if self.looking:
            self._once_more = True
            return
        self._soon.stop()
        self.looking, self._once_more, self._beside = True, False, Beside(self)
        self._beside.do(self._found, self._take)

    def look_anew(self) -> None:
        """Search because a person wants it. Undecided plugins are asked about again."""
        self._asked.clear()
        self.look()

    def unasked(self) -> FoundPlugin | None:
        """A new or changed plugin about which nobody was asked; it then counts as asked.

        None if there is none.
        """
        for found in self.loaded.waiting:
            key = found.location, found.digest
            # Generated functions are read on the page Design cycle, as a difference.
            if not (found.is_forbidden or found.is_generated or key in self._asked):
                self._asked.add(key)
                return found
        return None

    def stop(self) -> None:
        """Emit no further signals, and end the thread."""
        self._soon.stop()
        if self._beside is not None:
            self._beside.stop()
            self._beside.deleteLater()
        self._beside = None

    def _found(self) -> Loaded:
        try:
            return self._look()
        except HostError as error:
            return Loaded(faults=(PluginFault("plugins", str(error), None, "plugins"),))

    def _take(self, loaded: Loaded) -> None:
        names = ", ".join(plugin.name for plugin in loaded.plugins) or "none"
        self.news = f"Plugins looked at again: {names}" if self.known else ""
        self.loaded, self.known, self.looking = loaded, True, False
        self.stop()
        once_more = self._once_more
        self.changed.emit()
        if once_more and not self.looking:
            self.look()
