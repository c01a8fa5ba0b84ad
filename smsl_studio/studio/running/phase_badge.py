"""PhaseBadge: the state of a run in one word."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QSizePolicy

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Label
from smsl_studio.studio.base.tips import tip_text

HIGH = 32
NAMED = 130
"""Largest width of the name of a file (pixels); the tooltip has the whole name."""
BRIEF = {"Waiting for a human": "Waiting", "Goal reached": "At goal"}
"""The words of long states where there is little room. The colour stays."""


class PhaseBadge(Label):
    """The word for the state of a run, in its colour. Every bar with a Stop button shows it."""

    def __init__(self) -> None:
        super().__init__()
        self._kind, self._brief = "", False
        self._file, self._named = "", True
        self._said: tuple[str, str, str] | None = None
        self.setProperty("role", "phase")
        self.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.setFixedHeight(HIGH)
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)

    def show_phase(self, words: str, kind: str, tip: str = "") -> None:
        """Show the word of a run state; ``kind`` selects the colour. Called for each frame."""
        if (words, kind, tip) == self._said:
            return
        self._said = words, kind, tip
        self._write()
        if kind != self._kind:
            self._kind = kind
            self.setProperty("kind", kind)
            self.style().unpolish(self)
            self.style().polish(self)

    def set_brief(self, brief: bool) -> None:
        """Show as few letters as tell the state, where there is little room."""
        if brief != self._brief:
            self._brief = brief
            self._write()

    def show_file(self, file: str) -> None:
        """Name the file of the run, where another one is shown; empty names none."""
        if file != self._file:
            self._file = file
            self._write()

    def set_named(self, named: bool) -> None:
        """Show the name of the file, if there is one, or leave it to the tooltip."""
        if named != self._named:
            self._named = named
            self._write()

    def _write(self) -> None:
        words, kind, tip = self._said or ("", "quiet", "")
        shown = BRIEF.get(words, words) if self._brief else words
        dot = "" if self._brief or kind == "quiet" else "●  "
        of = f"The run of {self._file}" if self._file else "The run"
        if self._file and self._named and not self._brief:
            middle = Qt.TextElideMode.ElideMiddle
            name = self.fontMetrics().elidedText(plain_text(self._file), middle, NAMED)
            shown = f"{shown}: {name}"
        self.setText(f"{dot}{shown}")
        self.setToolTip(tip_text(f"{of}. {tip}".strip() if self._file else tip))
        self.setAccessibleName(plain_text(f"{of}: {words}"))
