"""All windows of the program: what they share, and actions on all of them."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from typing import TYPE_CHECKING, Protocol

from PySide6.QtCore import QObject, Qt, QTimer
from PySide6.QtWidgets import QApplication

from smsl_studio.legible import one_line
from smsl_studio.library.folders import name_plugin_folders
from smsl_studio.studio.base.actions import Actions
from smsl_studio.studio.base.calm import set_calm
from smsl_studio.studio.base.own_keys import read_keys, written_keys
from smsl_studio.studio.base.settings import KEYS, Settings
from smsl_studio.studio.base.style import dress, tokens_of
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.wheel_habit import set_wheel_scrolls
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.running.persons import Persons
from smsl_studio.studio.shell.departure import Departure
from smsl_studio.studio.shell.plugins import Plugins
from smsl_studio.studio.shell.sweeper import Sweeper

if TYPE_CHECKING:
    from smsl_studio.host.spare import Spare


class OpenWindow(Protocol):
    """What the program needs of each window."""

    @property
    def session(self) -> Session:
        """The blueprint that the window has open."""

    @property
    def actions_table(self) -> Actions:
        """Its actions."""

    @property
    def leaving(self) -> Departure:
        """The questions before it closes."""

    @property
    def name(self) -> str:
        """Its name in questions about several windows."""

    @property
    def runs(self) -> bool:
        """Whether something moves in its run, so that Stop must be heard at once."""

    def wear(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""

    def say(self, sentence: str) -> None:
        """Show a message."""

    def stop_run(self) -> None:
        """Stop its run."""

    def keep_unsaved(self) -> bool:
        """Write the journal now; returns whether there is unsaved work."""

    def leave_behind(self) -> bool:
        """Keep unsaved work for the next start; returns whether there is any."""

    def settle(self) -> None:
        """Take over what is still being typed."""

    def end_run(self) -> None:
        """End its run, so that the window can close."""

    def tell_failure(self, sentence: str) -> None:
        """Show that the program failed, and offer the report."""

    def isActiveWindow(self) -> bool:
        """Whether it has the keyboard focus."""

    def deleteLater(self) -> None:
        """Delete it when the event loop runs again."""


class Windows(QObject):
    """The open windows, the oldest first. Windows call ``add`` and ``remove`` themselves."""

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
        self._sweeper = Sweeper(self)
        set_calm(settings.calm)
        set_wheel_scrolls(settings.wheel_scrolls)
        name_plugin_folders(settings.plugin_folders)
        self.failure: tuple[str, str] | None = None
        """The last failure of the program: a sentence, and the trace; None if there was none."""
        self._open: list[OpenWindow] = []
        self._closed: list[OpenWindow] = []
        self._undressed = False
        # A method and not a lambda, so that Qt disconnects it when this object is deleted.
        application.styleHints().colorSchemeChanged.connect(self._desktop_changed)
        application.applicationStateChanged.connect(self._turned)

    def __iter__(self) -> Iterator[OpenWindow]:
        return iter(tuple(self._open))

    def add(self, window: OpenWindow) -> None:
        """Add a window that was opened."""
        self._open.append(window)

    def remove(self, window: OpenWindow) -> None:
        """Remove a closed window and free it with all that it holds."""
        if window in self._open:
            self._open.remove(window)
            # Without this, its own signal connections would keep it alive.
            window.deleteLater()
            # Qt crashes if a window is deleted while it closes, so it is kept until the event loop
            # runs.
            self._closed.append(window)
            QTimer.singleShot(0, self, self._closed.clear)
            self._sweeper.want_all()

    def is_in_front(self, window: object) -> bool:
        """Whether this window has the focus; if none has it, whether it is the oldest."""
        active = (shown for shown in self if shown.isActiveWindow())
        return next(active, next(iter(self), None)) is window

    @property
    def theme(self) -> str:
        """The name of the chosen theme."""
        return self.settings.theme

    @property
    def tokens(self) -> Tokens:
        """The colours of the chosen theme."""
        return tokens_of(self.theme, self.application)

    def set_theme(self, theme: str) -> None:
        """Set and remember the theme: light, dark, contrast, or system.

        Qt needs a second to dress all widgets, and hears no Stop meanwhile. So while something
        moves the look stays as it is, and the window says so.
        """
        self.settings.theme = theme
        self._undressed = True
        self.dress_late()
        for window in self if self._undressed else ():
            window.say("The look changes when the run pauses or ends, so that Stop is always heard")

    def dress_late(self) -> None:
        """Use the chosen theme, if it is another one and nothing moves."""
        if self._undressed and not any(window.runs for window in self):
            self._undressed = False
            dress(self.application, self.tokens)
            # All windows share the palette of the application.
            for window in self:
                window.wear(self.tokens)

    def set_calm(self, on: bool) -> None:
        """Let the views of all windows jump instead of gliding, and remember it."""
        self.settings.calm = on
        set_calm(on)

    def set_wheel_scrolls(self, on: bool) -> None:
        """Let a mouse wheel scroll the drawings of all windows, or zoom, and remember it."""
        self.settings.wheel_scrolls = on
        set_wheel_scrolls(on)

    def set_keys(self, action: str, keys: tuple[str, ...] | None) -> None:
        """Give an action other keys in all windows and remember them; None gives the shipped keys
        back."""
        chosen = read_keys(self.settings.text_of(KEYS))
        chosen.pop(action, None)
        chosen |= {action: keys} if keys is not None else {}
        self.settings.store_text(KEYS, written_keys(chosen))
        for window in self:
            table = window.actions_table
            table.set_keys(action, keys if keys is not None else table.shipped[action].keys)

    def set_plugin_folders(self, folders: tuple[str, ...]) -> None:
        """Search for plugins in these further folders, now and at each start."""
        self.settings.plugin_folders = folders
        name_plugin_folders(folders)
        self.look_for_plugins()

    def quit(self) -> None:
        """Close all windows after all questions are answered.

        If one window shall stay, all stay open.
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
        """Search for installed plugins again, for all windows."""
        self.plugins.look_anew()

    def stop_every_run(self) -> None:
        """Stop the runs of all windows: who presses F8 does not check which window is in front."""
        for window in self:
            window.stop_run()

    def fail(self, sentence: str, told: str) -> None:
        """Show in every window that the program failed; ``told`` is the trace, for the report."""
        self.failure = sentence, told
        for window in self:
            window.tell_failure(sentence)

    def keep(self) -> bool:
        """Write the journals of all windows now; returns whether one has unsaved work."""
        kept = [window.keep_unsaved() for window in self]
        return any(kept)

    def leave(self) -> None:
        """Close without questions, because the session or the terminal ends.

        Unsaved work is kept.
        """
        for window in self:
            # What comes in while the run ends can be an edit, so the work is kept after it.
            window.end_run()
            # Closing would take over what is being typed.
            window.settle()
            if window.leave_behind():
                said = f"unsaved work in {window.name} is kept, and offered at the next start"
                print(one_line(f"smsl-studio: {said}"), file=sys.stderr)
            window.leaving.agreed = True
        self.application.quit()

    def _desktop_changed(self) -> None:
        if self.theme == "system":
            self.set_theme("system")

    def _turned(self, state: Qt.ApplicationState) -> None:
        if state != Qt.ApplicationState.ApplicationActive:
            self._sweeper.want_all()
