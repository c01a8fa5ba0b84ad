"""The run beside the text: the world's picture, the drawing, the facts, and how to leave it."""

from __future__ import annotations

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtWidgets import QPushButton, QVBoxLayout, QWidget

from smsl_studio.front.views.fact_rows import as_they_were, fact_rows
from smsl_studio.studio.base.controls import label, row
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import capital
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.running.facts_table import FactsTable
from smsl_studio.studio.running.frames import split
from smsl_studio.studio.running.run_canvas import RunCanvas
from smsl_studio.studio.running.run_choice import RunChoice
from smsl_studio.studio.running.run_session import RunSession
from smsl_studio.studio.running.scene.world_view import WorldView

STARTING = "The world is being opened."
FRAME = 33
"""Milliseconds between two pictures of the world."""


class WatchColumn(QWidget):
    """Shows the run of this window while it is the one in which the step at hand is played.

    Nothing of another run is shown, because it would be taken for the step. A world without shapes
    has no picture; then the drawing has its room.
    """

    left = Signal()

    def __init__(self, session: Session, run: RunSession, tokens: Tokens) -> None:
        super().__init__()
        self._run = run
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setProperty("role", "side")
        self._played: RunChoice | None = None
        """What the step was begun with; None while no step is played."""
        self.title, self.said = label("", "sideStrong"), label("", "sideText")
        for words in (self.title, self.said):
            words.setWordWrap(True)
        self.leave = QPushButton("Back to the changes")
        self.leave.clicked.connect(self.left)
        self.canvas = RunCanvas(session, run, tokens)
        self.facts, self.world = FactsTable(tokens), WorldView(tokens)
        self.world.hide()
        self._frames = QTimer(self)
        self._frames.setInterval(FRAME)
        self._frames.timeout.connect(self._draw)
        head = QWidget()
        above = QVBoxLayout(head)
        above.setContentsMargins(16, 12, 16, 8)
        above.addLayout(row(label("Watch it run", "sideTitle"), None, self.leave))
        above.addWidget(self.title)
        above.addWidget(self.said)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(head)
        parts = self._parts = split(
            Qt.Orientation.Vertical,
            (self.world, self.canvas, self.facts),
            (280, 260, 160),
            (1, 1, 1),
        )
        column.addWidget(parts, 1)
        column.addStretch(0)
        self.world.came_into_view.connect(self._draw)
        run.opened.connect(self._show_world)
        run.changed.connect(self.refresh)
        run.progressed.connect(lambda: self.canvas.show_time(run.shown_time))

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.canvas.set_tokens(tokens)
        self.facts.set_tokens(tokens)
        self.world.set_tokens(tokens)

    def stop(self) -> None:
        """Draw no more, because the window closes."""
        self._frames.stop()
        self.world.close_graphics()

    def show_step(self, words: str, branch: str) -> None:
        """Say which step is played, after its run has begun, and show its SB."""
        self.title.setText(words)
        self._played = self._run.choice
        self.canvas.show_branch(branch)
        self._show_world()
        self.refresh()

    def show_none(self, heading: str, why: str) -> None:
        """Say why a step is not played."""
        self.title.setText(heading)
        self._played = None
        self.said.setText(why)
        self._show_world()
        self.refresh()

    @property
    def plays(self) -> bool:
        """Whether the run of the window is still that of the step."""
        return self._played is not None and self._run.choice is self._played

    def refresh(self) -> None:
        """Show the present state of the run."""
        if self.isHidden():
            return
        run = self._run
        self._parts.setVisible(self.plays)
        if not self.plays:
            if self._played is not None:
                self.said.setText("Another run has begun since. Run mode shows it.")
            return
        self.canvas.refresh()
        if run.status is None or run.blueprint is None:
            self.facts.show_rows(())
            self.said.setText(STARTING if run.exists else capital(run.sentence))
            return
        rows = fact_rows(run.blueprint, run.status, run.phase == "failed")
        self.facts.show_rows(rows if run.exists else as_they_were(rows))
        self.said.setText(capital(run.sentence) or "The step is being carried out.")

    def _show_world(self) -> None:
        """Show the picture of the world that is open now, if it has one."""
        run = self._run
        if not self.plays:
            self.world.hide()
            self._frames.stop()
            return
        self.world.load(run.shapes, run.choice.world if run.choice else "")
        self.world.setVisible(self.world.has_picture)
        self._draw()
        if run.exists and self.world.has_picture:
            self._frames.start()

    def _draw(self) -> None:
        """Draw the newest poses, and no more when the run has ended."""
        run = self._run
        if self.world.isVisible():
            self.world.show_poses(run.poses(), run.words(), last=not run.exists)
        if not run.exists:
            self._frames.stop()
