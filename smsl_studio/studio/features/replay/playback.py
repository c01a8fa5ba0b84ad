"""The replay of a window: opening a recording, its pane, and its transport."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QMenu, QWidget

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.recordings import (
    SUFFIX,
    Recording,
    recording_words,
    recordings_in,
)
from smsl_studio.studio.base.file_dialogs import ask_to_open
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import as_it_is
from smsl_studio.studio.features.replay.loader import RecordingLoader
from smsl_studio.studio.features.replay.opening_card import OpeningCard
from smsl_studio.studio.features.replay.pane import ReplayPane
from smsl_studio.studio.features.replay.replay import Replay
from smsl_studio.studio.features.replay.transport import ReplayTransport

KINDS = f"Recorded runs (*{SUFFIX});;All files (*)"


class ReplayVerbs(QObject):
    """The replay of a window. ``pane`` is its body, ``transport`` its row of the mode bar."""

    opened = Signal()
    """A recording was opened."""
    closed = Signal()
    """The recording was closed."""
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
        # With a parent both are freed with the window, also if no recording is ever shown.
        self.transport = ReplayTransport(self.replay, tokens, window)
        self.pane = ReplayPane(self.replay, drawn(), tokens, window)
        self.transport.hide()
        self.pane.hide()
        self.opening = RecordingLoader(self)
        self.card = OpeningCard(self.opening, tokens, window)
        self.transport.close_wanted.connect(self.close)
        self.opening.refused.connect(self.refused)
        self.opening.opened.connect(self._show)

    @property
    def is_open(self) -> bool:
        """Whether a recording is open."""
        return self.replay.recording is not None

    def open(self, path: Path | None = None) -> None:
        """Show a recording when it has been read; without ``path`` ask for one."""
        if path is None:
            start = str(self._folder if self._folder.is_dir() else Path.home())
            name = ask_to_open(self._window, "Open recording", start, KINDS)
            if not name:
                return
            path = Path(name)
        self.opening.open(path, self._drawn())

    def close(self) -> None:
        """Close the recording."""
        if self.is_open:
            self.replay.pause()
            self.closed.emit()
            self.replay.show(None)

    def stop(self) -> None:
        """End all work, because the window closes."""
        self.replay.pause()
        self.opening.stop()

    def fill(self, menu: QMenu) -> None:
        """Fill a menu with the newest recordings of the user's folder."""
        menu.clear()
        for path in recordings_in(self._folder):
            words = as_it_is(recording_words(path))
            menu.addAction(words, partial(self.open, path)).setToolTip(tip_text(str(path)))
        if menu.isEmpty():
            menu.addAction("No run was recorded yet").setEnabled(False)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.transport.set_tokens(tokens)
        self.pane.set_tokens(tokens)
        self.card.set_tokens(tokens)

    def _show(self, recording: Recording) -> None:
        self.replay.show(recording)
        self.opened.emit()
