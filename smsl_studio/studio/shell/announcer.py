"""Reads out what changes in a window while the keyboard focus is elsewhere."""

from __future__ import annotations

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QWidget

from smsl_studio.studio.base.announcement import announce

HELD = "held"
"""The kind of the run states in which nothing goes on until somebody acts."""
QUIET = ("", "checking")
"""Words about findings that are no news: the inspection goes on."""


class Announcer(QObject):
    """Announces the state of the run and the sum of the findings, each when it has changed.

    A hold interrupts what is being read and tells its reason. Questions to people and messages are
    announced where they are made.
    """

    def __init__(self, window: QWidget) -> None:
        super().__init__(window)
        self._window = window
        self._phase = self._reason = self._findings = ""

    def tell_phase(self, words: str, kind: str, sentence: str) -> None:
        """Take the word for the run's state, its kind, and the sentence about it."""
        held = kind == HELD
        news = words != self._phase or (held and sentence != self._reason)
        first = not self._phase
        self._phase, self._reason = words, sentence
        if news and not (first and kind == "quiet"):
            reason = f" {sentence}" if held else ""
            announce(self._window, f"The run: {words}.{reason}", urgent=held)

    def tell_findings(self, words: str) -> None:
        """Take the sum of the findings in words. The first one of a window is no news."""
        if words in QUIET or words == self._findings:
            return
        first, self._findings = not self._findings, words
        if not first:
            announce(self._window, f"Findings: {words}.")
