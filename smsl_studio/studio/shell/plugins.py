"""What the installed plugins offer, as all windows know it. Their code never runs here."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QObject, Signal

from smsl_studio.errors import HostError
from smsl_studio.host.plugin_offers import describe
from smsl_studio.library.loading import Loaded, PluginFault
from smsl_studio.library.survey import FoundPlugin, PluginState
from smsl_studio.studio.base.beside import Beside


class Plugins(QObject):
    """The plugins that were found last; ``look`` finds them, beside the window's own work.

    ``known`` says whether they were looked for at all. A run always loads its plugins anew, in its
    own process: looking again is for what the window offers.
    """

    changed = Signal()

    def __init__(self, look: Callable[[], Loaded] = describe) -> None:
        super().__init__()
        self.loaded, self.known, self.looking = Loaded(), False, False
        self.news = ""
        """What looking again has found, in a sentence; empty the first time."""
        self._look = look
        self._asked: set[tuple[str, str]] = set()
        self._once_more = False
        self._beside: Beside | None = None

    def look(self) -> None:
        """Look for them (again); ``changed`` tells when that is done.

        Asked for while it is being done, it is done once more: something may have changed since.
        """
        if self.looking:
            self._once_more = True
            return
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
            if found.state is not PluginState.FORBIDDEN and key not in self._asked:
                self._asked.add(key)
                return found
        return None

    def stop(self) -> None:
        """Nobody is told any more, and no thread waits for more work."""
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
