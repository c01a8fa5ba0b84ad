"""All windows of the program: what they share, and what is done to every one of them."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from typing import TYPE_CHECKING, Protocol

from PySide6.QtCore import QObject, QTimer
from PySide6.QtWidgets import QApplication

from smsl_studio.legible import one_line
from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.base.style import dress, tokens_of
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.running.persons import Persons
from smsl_studio.studio.shell.departure import Departure
from smsl_studio.studio.shell.plugins import Plugins

if TYPE_CHECKING:
    from smsl_studio.host.spare import Spare


class OpenWindow(Protocol):
    """What is asked of each window."""

    @property
    def session(self) -> Session:
        """The blueprint that the window has open."""

    @property
    def leaving(self) -> Departure:
        """What asks before it closes."""

    @property
    def name(self) -> str:
        """The name it goes by in questions about several windows."""

    def wear(self, tokens: Tokens) -> None:
        """Take the colours of another theme."""

    def stop_run(self) -> None:
        """Stop its run."""

    def keep_unsaved(self) -> bool:
        """Write the journal now; answers whether there is unsaved work."""

    def leave_behind(self) -> bool:
        """Keep unsaved work for the next start; answers whether there is any."""

    def settle(self) -> None:
        """Take over what is still being typed."""

    def end_run(self) -> None:
        """End its run, so that the window can close."""

    def warn(self, words: str) -> None:
        """Say something to the person who works here."""

    def isActiveWindow(self) -> bool:
        """Whether it has the keys."""

    def deleteLater(self) -> None:
        """Go, once the event loop is reached again."""


class Windows(QObject):
    """The windows that are open, oldest first; each tells when it comes and goes."""

    def __init__(
        self,
        application: QApplication,
        settings: Settings,
        plugins: Plugins | None = None,
        spare: Spare | None = None,
    ) -> None:
        super().__init__()
        self.application, self.settings = application, settings
        self.plugins = plugins or Plugins()
        self.spare = spare
        self.persons = Persons(settings)
        self._open: list[OpenWindow] = []
        self._closed: list[OpenWindow] = []
        # A method, not a lambda: it is let go of with this object.
        application.styleHints().colorSchemeChanged.connect(self._desktop_changed)

    def __iter__(self) -> Iterator[OpenWindow]:
        return iter(tuple(self._open))

    def add(self, window: OpenWindow) -> None:
        """Add a window that was opened."""
        self._open.append(window)

    def remove(self, window: OpenWindow) -> None:
        """The window was closed; it is let go of with all that it held."""
        if window in self._open:
            self._open.remove(window)
            # Its own connections would keep it for ever.
            window.deleteLater()
            # One that is let go of while it is being closed takes Qt along.
            self._closed.append(window)
            QTimer.singleShot(0, self, self._closed.clear)

    def is_in_front(self, window: object) -> bool:
        """Whether this window has the keys, or none has and it is the oldest."""
        active = (shown for shown in self if shown.isActiveWindow())
        return next(active, next(iter(self), None)) is window

    @property
    def theme(self) -> str:
        """The name of the chosen theme."""
        return self.settings.theme

    @property
    def tokens(self) -> Tokens:
        """The colours of the theme that is chosen."""
        return tokens_of(self.theme, self.application)

    def set_theme(self, theme: str) -> None:
        """Dress everything in light, dark, or what the desktop asks for; remembered."""
        self.settings.theme = theme
        dress(self.application, self.tokens)
        # The palette is the application's, so every window of it changes.
        for window in self:
            window.wear(self.tokens)

    def quit(self) -> None:
        """Close every window, once all that is asked about each is answered.

        Where one shall stay, all stay as they are.
        """
        several = len(self._open) > 1
        for window in self:
            if not window.leaving.ask(several):
                return
        if all(window.leaving.save() for window in self):
            for window in self:
                window.leaving.agreed = True
            self.application.closeAllWindows()

    def look_for_plugins(self) -> None:
        """Look at the installed plugins again, for all windows."""
        self.plugins.look_anew()

    def stop_every_run(self) -> None:
        """Stop the runs of all windows: who presses F8 does not look which one is in front."""
        for window in self:
            window.stop_run()

    def warn(self, words: str) -> None:
        """Say something in every window."""
        for window in self:
            window.warn(words)

    def keep(self) -> bool:
        """Write the journal of every window now; whether one of them holds unsaved work."""
        kept = [window.keep_unsaved() for window in self]
        return any(kept)

    def leave(self) -> None:
        """Close without a question: the session or the terminal ends. Unsaved work is kept."""
        for window in self:
            # Closing takes over what is being typed: by then it would be asked about.
            window.settle()
            if window.leave_behind():
                said = f"unsaved work in {window.name} is kept, and offered at the next start"
                print(one_line(f"smsl-studio: {said}"), file=sys.stderr)
            window.session.history.setClean()
            window.end_run()
        self.application.quit()

    def _desktop_changed(self) -> None:
        if self.theme == "system":
            self.set_theme("system")
