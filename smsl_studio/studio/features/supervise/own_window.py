"""The partial view in a window of its own, for a second screen. Stop is there, too."""

from __future__ import annotations

from PySide6.QtWidgets import QDialog, QVBoxLayout, QWidget

from smsl_studio.front.views.phase_words import phase_words
from smsl_studio.studio.base.controls import row
from smsl_studio.studio.base.key_button import command_button
from smsl_studio.studio.base.run_keys import lend_run_keys
from smsl_studio.studio.base.screens import open_at
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.running.phase_badge import PhaseBadge
from smsl_studio.studio.running.run_session import RunSession

SIZE = 900, 640


class OwnWindow(QDialog):
    """Holds a part of Supervise. When it is ``finished``, the part can go back to its place."""

    def __init__(self, part: QWidget, tokens: Tokens, window: QWidget) -> None:
        super().__init__(window)
        self.setWindowTitle("Partial view")
        self.phase, self.stop = PhaseBadge(), command_button("stop", "stop", tokens)
        self.stop.setFixedWidth(136)
        self.stop.setToolTip("A controlled stop, at any time (F8)")
        top = row(None, self.phase, self.stop)
        top.setContentsMargins(12, 8, 12, 8)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addLayout(top)
        column.addWidget(part, 1)
        part.show()
        lend_run_keys(self, window)
        open_at(self, *SIZE)

    def show_run(self, run: RunSession) -> None:
        """Show the word for the state of the run, and Stop while there is a run."""
        self.phase.show_phase(*phase_words(run.phase, run.over), run.sentence)
        self.stop.setEnabled(run.exists)
