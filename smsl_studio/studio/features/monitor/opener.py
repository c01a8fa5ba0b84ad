"""Opens the monitor in a window of its own, and keeps it."""

from __future__ import annotations

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget

from smsl_studio.studio.base.run_keys import lend_run_keys
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.monitor.window import MonitorWindow
from smsl_studio.studio.running.run_session import RunSession


class MonitorOpener(QObject):
    """The monitor beside one window, made when it is first shown."""

    changed = Signal()
    """It was opened or closed."""

    def __init__(self, run: RunSession, tokens: Tokens, parent: QWidget) -> None:
        super().__init__(parent)
        self._run, self._tokens, self._parent = run, tokens, parent
        self.window: MonitorWindow | None = None

    @property
    def is_open(self) -> bool:
        """Whether it is visible."""
        return self.window is not None and self.window.isVisible()

    def toggle(self) -> None:
        """Show it; close it if it is in front already."""
        if self.window is not None and self.is_open and self.window.isActiveWindow():
            self.window.close()
        else:
            self.show()

    def show(self) -> None:
        """Show it in front of its window."""
        if self.window is None:
            self.window = MonitorWindow(self._run, self._tokens, self._parent)
            lend_run_keys(self.window, self._parent.window(), {"monitor"})
            self.window.finished.connect(lambda _: self.changed.emit())
        self.window.show()
        self.window.raise_()
        self.window.activateWindow()
        self.changed.emit()

    def close(self) -> None:
        """Close it, because its window closes."""
        if self.window is not None:
            self.window.close()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme, also if it is made later."""
        self._tokens = tokens
        if self.window is not None:
            self.window.set_tokens(tokens)
