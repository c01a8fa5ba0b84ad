"""Turns typed text into a step of the history, after a short pause or at once.

A worker thread reads a large text. If it was changed meanwhile, it is read again.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from PySide6.QtCore import QObject, QTimer

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.studio.base.beside import Beside
from smsl_studio.studio.document.broken import Reading, read_text
from smsl_studio.studio.document.session import Session

PAUSE = 300
"""Milliseconds without a key before the text is read."""
LARGE = 200_000
"""Texts with at least this many characters are read by a worker thread."""


class TypedText(QObject):
    """Holds that something was typed, until the text is read.

    ``text`` returns the text of the editor; ``file`` is its file.
    """

    def __init__(self, session: Session, text: Callable[[], str], parent: QObject) -> None:
        super().__init__(parent)
        self._session, self._text = session, text
        self.file = ""
        self._words, self._serial = "", 0
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.setInterval(PAUSE)
        self._timer.timeout.connect(self._paused)
        self._beside = Beside(self)

    @property
    def pending(self) -> bool:
        """Whether something was typed that is not yet part of the history."""
        return bool(self._words)

    def begin(self, words: str) -> None:
        """Tell that something was typed.

        ``words`` name the step if it is the first of its burst.
        """
        self._words = self._words or words
        self._serial += 1
        self._timer.start()

    def settle(self) -> None:
        """Take over the typed text now."""
        if self._words and self.file not in self._session.texts:
            self.forget()
        if self._words:
            self._take(read_text(self._session.blueprint, self.file, self._text()))

    def hurry(self) -> None:
        """Take over the typed text as soon as possible, without blocking the window."""
        if self._words:
            self._timer.stop()
            self._paused()

    def forget(self) -> None:
        """Forget that something was typed."""
        self._timer.stop()
        self._words = ""

    def stop(self) -> None:
        """End all work, because the window closes."""
        self.forget()
        self._beside.stop()

    def _take(self, reading: Reading) -> None:
        words = self._words
        self.forget()
        self._session.take(words, reading, self.file)

    def _paused(self) -> None:
        text = self._text()
        if len(text) < LARGE or self.file not in self._session.texts:
            self.settle()
            return
        former = self._session.blueprint
        self._beside.drop()
        self._beside.do(
            partial(read_text, former, self.file, text),
            partial(self._arrived, self._serial, former),
        )

    def _arrived(self, serial: int, former: Blueprint, reading: Reading) -> None:
        if not self._words or serial != self._serial:
            return
        if former is self._session.blueprint:
            self._take(reading)
        else:
            self._timer.start()
