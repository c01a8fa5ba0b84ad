"""What the installed plugins offer, as all windows know it. Their code never runs here."""

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
"""Milliseconds from the first window to the look for plugins: it is drawn first."""


def described() -> Loaded:
    """What the plugins offer; what that takes is loaded when it is first asked for."""
    from smsl_studio.host.plugin_offers import describe

    return describe()


class Plugins(QObject):
    """The plugins that were found last; ``look`` finds them, beside the window's own work.

    ``known`` says whether they were looked for at all. A run always loads its plugins anew, in its
    own process: looking again is for what the window offers.
    """

    changed = Signal()

    def __init__(self, look: Callable[[], Loaded] = described) -> None:
        super().__init__()
        self.loaded, self.known, self.looking = Loaded(), False, False
        self.news = ""
        """What looking again has found, in a sentence; empty the first time."""
        self._look = look
        self._asked: set[tuple[str, str]] = set()
        self._once_more = False
        self._beside: Beside | None = None
        self._soon = QTimer(self)
        self._soon.setSingleShot(True)
        self._soon.setInterval(SOON)
        self._soon.timeout.connect(self.look)

    def look_soon(self) -> None:
        """Look for them once the window is drawn, where nobody has looked yet."""
        if not self.known and not self.looking:
            # The wait begins when the event loop has nothing else to do.
            QTimer.singleShot(0, self._soon, self._soon.start)

    def look(self) -> None:
        """Look for them (again); ``changed`` tells when that is done.

        Asked for while it is being done, it is done once more: something may have changed since.
        """
        if self.looking:
            self._once_more = True
            return
        self._soon.stop()
        self.looking, self._once_more, self._beside = True, False, Beside(self)
        self._beside.do(self._found, self._take)

    def look_anew(self) -> None:
        """Look for them because a person wants it: what they left open is asked again."""
        self._asked.clear()
        self.look()

    def unasked(self) -> FoundPlugin | None:
        """A plugin that is new or has changed; from now on somebody was asked about it."""
        for found in self.loaded.waiting:
            key = found.location, found.digest
            if not found.is_forbidden and key not in self._asked:
                self._asked.add(key)
                return found
        return None

    def stop(self) -> None:
        """Nobody is told any more, and no thread waits for more work."""
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
