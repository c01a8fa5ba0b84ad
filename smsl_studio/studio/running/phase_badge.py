"""PhaseBadge: the state of a run in one word."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QSizePolicy

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Label
from smsl_studio.studio.base.tips import tip_text

HIGH = 32
BRIEF = {"Waiting for a human": "Waiting", "Goal reached": "At goal"}
"""The words of long states where there is little room. The colour stays."""


class PhaseBadge(Label):
    """The word for the state of a run, in its colour. Every bar with a Stop button shows it."""

    def __init__(self) -> None:
        super().__init__()
        self._kind, self._brief = "", False
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
        self.setToolTip(tip_text(tip))
        self.setAccessibleName(plain_text(f"The run: {words}"))
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

    def _write(self) -> None:
        words, kind, _ = self._said or ("", "quiet", "")
        if self._brief:
            self.setText(BRIEF.get(words, words))
        else:
            self.setText(words if kind == "quiet" else f"●  {words}")
