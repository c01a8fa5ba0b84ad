"""Opens the monitor page and keeps it beside the window."""

from __future__ import annotations

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget

from smsl_studio.studio.base.run_keys import lend_run_keys
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.monitor.page import MonitorPage
from smsl_studio.studio.running.run_session import RunSession


class MonitorOpener(QObject):
    """The monitor page of one window, made when it is first shown."""

    changed = Signal()
    """The page was opened or closed."""

    def __init__(self, run: RunSession, tokens: Tokens, parent: QWidget) -> None:
        super().__init__(parent)
        self._run, self._tokens, self._window = run, tokens, parent
        self.page: MonitorPage | None = None

    @property
    def is_open(self) -> bool:
        """Whether the page is visible."""
        return self.page is not None and self.page.isVisible()

    def toggle(self) -> None:
        """Show the page; close it if it is in front already."""
        if self.page is not None and self.is_open and self.page.isActiveWindow():
            self.page.close()
        else:
            self.show()

    def show(self) -> None:
        """Show the page in front of the window."""
        if self.page is None:
            self.page = MonitorPage(self._run, self._tokens, self._window)
            lend_run_keys(self.page, self._window.window(), {"monitor"})
            self.page.finished.connect(lambda _: self.changed.emit())
        self.page.show()
        self.page.raise_()
        self.page.activateWindow()
        self.changed.emit()

    def close(self) -> None:
        """Close the page, because its window closes."""
        if self.page is not None:
            self.page.close()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme, also for a page that is made later."""
        self._tokens = tokens
        if self.page is not None:
            self.page.set_tokens(tokens)
