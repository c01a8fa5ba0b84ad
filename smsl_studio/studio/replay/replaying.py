"""Replaying in a window: which recording is opened, and what F5, F6 and F10 do meanwhile."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtWidgets import QApplication, QFileDialog, QMenu, QWidget

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import StudioError
from smsl_studio.studio.replay.pane import ReplayPane
from smsl_studio.studio.replay.recording import (
    SUFFIX,
    open_recording,
    recording_words,
    recordings_in,
)
from smsl_studio.studio.replay.replay import Replay
from smsl_studio.studio.replay.transport import ReplayTransport
from smsl_studio.studio.theme import Tokens

KINDS = f"Recorded runs (*{SUFFIX});;All files (*)"


class Replaying(QObject):
    """The replay of a window: ``pane`` is its body, ``transport`` its row of the mode bar."""

    opened = Signal()
    """A recording is there to be shown."""
    closed = Signal()
    """It was let go of."""
    refused = Signal(object)
    """A StudioError: the recording cannot be shown."""

    def __init__(
        self,
        drawn: Callable[[], Blueprint],
        folder: Path,
        tokens: Tokens,
        window: QWidget,
    ) -> None:
        super().__init__(window)
        self._drawn, self._folder, self._window = drawn, folder, window
        self.replay = Replay(self)
        self.transport = ReplayTransport(self.replay, tokens)
        self.pane = ReplayPane(self.replay, drawn(), tokens)
        self.transport.close_wanted.connect(self.close)

    @property
    def is_open(self) -> bool:
        return self.replay.recording is not None

    def open(self, path: Path | None = None) -> bool:
        """Show a recording (asking which); whether there is one to be seen."""
        if path is None:
            start = str(self._folder if self._folder.is_dir() else Path.home())
            name, _ = QFileDialog.getOpenFileName(self._window, "Open recording", start, KINDS)
            if not name:
                return False
            path = Path(name)
        QApplication.setOverrideCursor(Qt.CursorShape.WaitCursor)
        try:
            recording = open_recording(path, self._drawn())
        except StudioError as error:
            self.refused.emit(error)
            return False
        finally:
            QApplication.restoreOverrideCursor()
        self.replay.show(recording)
        self.opened.emit()
        return True

    def close(self) -> None:
        """Let go of the recording."""
        if self.is_open:
            self.replay.pause()
            self.closed.emit()
            self.replay.show(None)

    def fill(self, menu: QMenu) -> None:
        """The newest recordings of the user's folder."""
        menu.clear()
        for path in recordings_in(self._folder):
            words = recording_words(path).replace("&", "&&")
            menu.addAction(words, partial(self.open, path)).setToolTip(str(path))
        if menu.isEmpty():
            menu.addAction("No run was recorded yet").setEnabled(False)

    def set_tokens(self, tokens: Tokens) -> None:
        self.transport.set_tokens(tokens)
        self.pane.set_tokens(tokens)
