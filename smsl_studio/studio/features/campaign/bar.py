"""The row of the campaign in the mode bar: what runs where, and New, Export, Pause and Stop."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QHBoxLayout, QPushButton, QWidget

from smsl_studio.studio.base.controls import Elided, rule
from smsl_studio.studio.base.key_button import KeyButton, command_button
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.features.campaign.work import DONE, PAUSED, PAUSING, RUNNING, CampaignWork
from smsl_studio.studio.running.phase_badge import PhaseBadge

PHASES = {
    RUNNING: ("Campaign running", "busy"),
    PAUSING: ("Pausing after this run", "busy"),
    PAUSED: ("Campaign paused", "unknown"),
    DONE: ("Campaign done", "good"),
}
NARROW, BARE = 800, 560
"""Widths (pixels) from which buttons have words, and the phase and Export are shown."""


class CampaignBar(QWidget):
    """Buttons and words. Stop has the place and the size that it has for a run."""

    new_wanted, export_wanted = Signal(), Signal()
    turn_wanted, stop_wanted = Signal(), Signal()

    def __init__(self, work: CampaignWork, tokens: Tokens) -> None:
        super().__init__()
        self._work, self._run_exists = work, False
        self.words, self.phase = Elided(), PhaseBadge()
        self.new, self.export = QPushButton("New campaign…"), QPushButton("Export…")
        self.new.setToolTip(tip_text("Choose world, faults, seeds and who carries them out"))
        self.export.setToolTip(
            tip_text("Save a report as a page, or the results as JSON or Parquet")
        )
        self.turn = KeyButton("Pause", "F6", "pause", "primary", tokens)
        self.stop = command_button("stop", "stop", tokens)
        self.stop.setFixedWidth(136)
        self.stop.setToolTip(tip_text("End all workers now, and a run if there is one (F8)"))
        across = QHBoxLayout(self)
        across.setContentsMargins(0, 0, 0, 0)
        across.setSpacing(8)
        across.addWidget(self.words, 1)
        line = rule(vertical=True, length=24)
        for part in (self.phase, self.export, self.new, self.turn, line, self.stop):
            across.addWidget(part)
        self.new.clicked.connect(self.new_wanted)
        self.export.clicked.connect(self.export_wanted)
        self.turn.clicked.connect(self.turn_wanted)
        self.stop.clicked.connect(self.stop_wanted)
        work.changed.connect(self.refresh)
        self.refresh()

    def show_run(self, exists: bool) -> None:
        """Take note whether there is a run, which Stop stops too."""
        self._run_exists = exists
        self.refresh()

    def refresh(self) -> None:
        """Show what the campaign does."""
        work, request = self._work, self._work.request
        words, kind = PHASES.get(work.phase, ("No campaign", "quiet"))
        self.phase.show_phase(words, kind)
        self.phase.setAccessibleName(words)
        told = []
        if request is not None:
            robot = f", {request.robot}" if request.robot else ""
            told = [f"World {request.world}{robot}", counted(request.seeds, "seed")]
            told.append("Dask" if request.dask else counted(request.workers, "worker"))
        self.words.setText("   ".join(told))
        paused = work.phase == PAUSED
        if paused:
            self.turn.set_words("Resume", "F5", "play")
        else:
            self.turn.set_words("Pause", "F6", "pause")
        tip = (
            "Go on. What is done is not run again"
            if paused
            else ("Let the current run end, and keep what is done")
        )
        self.turn.setToolTip(tip_text(f"{tip} ({'F5' if paused else 'F6'})"))
        self.turn.setEnabled(paused or work.phase == RUNNING)
        self.export.setEnabled(work.tally.done > 0)
        self.stop.setEnabled(work.moves or self._run_exists)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.turn.set_tokens(tokens)
        self.stop.set_tokens(tokens)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """In a narrow row hide what is not needed at once; Stop never is."""
        super().resizeEvent(event)
        wide = self.width()
        self.turn.set_short(wide < NARROW, wide < BARE)
        self.phase.setVisible(wide >= NARROW)
        self.export.setVisible(wide >= BARE)
        self.new.setVisible(wide >= BARE)
