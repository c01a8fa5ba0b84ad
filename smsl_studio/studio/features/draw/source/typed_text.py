"""Typing: what is being typed becomes a step of the history after a short pause, or at once.

A large text is read beside the window's own thread; what was typed meanwhile is read again.
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
"""Milliseconds without a key after which the text is read."""
LARGE = 200_000
"""Characters from which on it is read beside the window's own thread."""


class TypedText(QObject):
    """Holds what is typed until it is read. ``text`` gives it, ``file`` says whose it is."""

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
        """Something was typed; ``words`` name the step, should it be the first of its burst."""
        self._words = self._words or words
        self._serial += 1
        self._timer.start()

    def settle(self) -> None:
        """Take over now what was typed."""
        if self._words and self.file not in self._session.texts:
            self.forget()
        if self._words:
            self._take(read_text(self._session.blueprint, self.file, self._text()))

    def hurry(self) -> None:
        """Take over what was typed as soon as can be, without keeping anybody waiting."""
        if self._words:
            self._timer.stop()
            self._paused()

    def forget(self) -> None:
        """What was typed is no longer there."""
        self._timer.stop()
        self._words = ""

    def stop(self) -> None:
        """The window is going away."""
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
