"""The monitor in a window of its own, with a Stop of its own."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QDialog, QVBoxLayout, QWidget

from smsl_studio.front.views.phase_words import phase_words
from smsl_studio.studio.base.controls import row, rule
from smsl_studio.studio.base.key_button import command_button
from smsl_studio.studio.base.screens import open_at
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.monitor.page import SIZE, MonitorPage
from smsl_studio.studio.running.phase_badge import PhaseBadge
from smsl_studio.studio.running.run_session import RunSession


class MonitorWindow(QDialog):
    """A non-modal dialog about the present run of its window. It can stand beside Supervise or on
    another screen. It can cover its window, so it has the same Stop."""

    def __init__(self, run: RunSession, tokens: Tokens, parent: QWidget) -> None:
        super().__init__(parent)
        self.setWindowFlag(Qt.WindowType.WindowMaximizeButtonHint, True)
        self.setWindowTitle("Monitor")
        self._run = run
        self.page = MonitorPage(run, tokens)
        self.page.apart.hide()
        self.phase, self.stop = PhaseBadge(), command_button("stop", "stop", tokens)
        self.stop.setFixedWidth(136)
        self.stop.setToolTip("A controlled stop, at any time (F8)")
        self.stop.clicked.connect(lambda: self._run.stop())
        top = row(self.page.head, self.phase, self.stop)
        top.setContentsMargins(12, 8, 12, 8)
        top.setStretch(0, 1)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(0, 0, 0, 0)
        whole.setSpacing(0)
        whole.addLayout(top)
        whole.addWidget(rule())
        whole.addWidget(self.page, 1)
        open_at(self, *SIZE)
        run.changed.connect(self.refresh)
        run.opened.connect(self.refresh)
        self.refresh()

    def refresh(self) -> None:
        """Show the word for the state of the run, and Stop while there is a run."""
        run = self._run
        file = Path(run.blueprint.file).name if run.foreign and run.blueprint is not None else ""
        self.phase.show_file(file)
        self.phase.show_phase(*phase_words(run.phase), run.sentence)
        for part in (self.phase, self.stop):
            part.setVisible(run.exists)

    def showEvent(self, event: QShowEvent) -> None:
        """Give the keyboard focus to the table."""
        super().showEvent(event)
        self.refresh()
        self.page.table.setFocus()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.stop.set_tokens(tokens)
        self.page.set_tokens(tokens)
