"""The page Campaign of Run: how far it is, the table of its rows, and the chosen cell."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import (
    QProgressBar,
    QPushButton,
    QStackedWidget,
    QVBoxLayout,
    QWidget,
)

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.studio.base.controls import Elided, label, row, rule
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.features.campaign.atlas import AtlasTable
from smsl_studio.studio.features.campaign.side import CampaignSide
from smsl_studio.studio.features.campaign.work import DONE, PAUSED, PAUSING, RUNNING, CampaignWork
from smsl_studio.studio.running.frames import split

EMPTY = "No campaign yet. Choose faults and seeds."
LEGEND = (
    "✓ reached the goal    ‖ held before it    ✗ failed    ⊘ refused, did not begin    "
    "— cannot occur there    dashed: not yet run    "
    "two short ticks: foreseen above, seen below; apart: they differ"
)
ANOTHER = "Made for another version of the drawing"
PHASES = {RUNNING: "Running", PAUSING: "Pausing after this run", PAUSED: "Paused", DONE: "Done"}


class CampaignPage(QWidget):
    """The page. It shows the work and does nothing by itself."""

    new_wanted, rates_wanted = Signal(), Signal()
    finding_wanted = Signal(object)
    """CampaignCell: a cell that ended otherwise than foreseen shall stand on the drawing as a
    note."""
    replay_wanted = Signal(object, int)
    """CampaignCell, seed: the person wants to see this run again."""
    story_wanted = Signal(object, int)
    """CampaignCell, seed: the events of this run are to stand at the right."""

    def __init__(self, work: CampaignWork, tokens: Tokens) -> None:
        super().__init__()
        self._work = work
        self._blueprint: Blueprint | None = None
        self.setAccessibleName("Campaign")
        self.done, self.words = label("", "heading"), Elided()
        self.bar = QProgressBar()
        self.bar.setFixedSize(128, 6)
        self.bar.setTextVisible(False)
        self.bar.setAccessibleName("Runs that are done")
        self.rates = _button("Costs and risks…", "See what the runs say of costs and risks, and "
                             "write it into the blueprint")  # fmt: skip
        self.differ = _button("", "Show only what ended otherwise than the blueprint foresees")
        self.differ.setCheckable(True)
        self.differ.setProperty("role", "switch")
        self.differ.toggled.connect(lambda _: self._show_foresight())
        self.table, self.side = AtlasTable(tokens), CampaignSide(tokens)
        self.begin = QPushButton("New campaign…")
        self.begin.setProperty("role", "primary")
        self.begin.setToolTip(tip_text("Choose world, faults, seeds and who carries them out"))
        self._build()
        self.table.cell_chosen.connect(lambda _: self._show_cell())
        self.side.replay_wanted.connect(self._replay)
        self.side.story_wanted.connect(self._tell_story)
        self.side.finding_wanted.connect(self._open_finding)
        self.begin.clicked.connect(self.new_wanted)
        self.rates.clicked.connect(self.rates_wanted)
        work.changed.connect(self.refresh)
        self.refresh()

    def _build(self) -> None:
        self._head = QWidget()
        top = row(self.done, self.bar, self.words, spacing=12)
        top.setStretch(2, 1)
        top.addWidget(self.differ)
        top.addWidget(self.rates)
        top.setContentsMargins(16, 8, 16, 8)
        self._head.setLayout(top)
        legend = label(LEGEND, "small")
        legend.setContentsMargins(16, 6, 16, 8)
        legend.setWordWrap(True)
        left = QWidget()
        column = QVBoxLayout(left)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self.table, 1)
        column.addWidget(rule())
        column.addWidget(legend)
        self.side.setMinimumWidth(270)
        whole = QWidget()
        self._across = split(Qt.Orientation.Horizontal, (left, self.side), (1044, 396), (3, 1))
        inner = QVBoxLayout(whole)
        inner.setContentsMargins(0, 0, 0, 0)
        inner.setSpacing(0)
        inner.addWidget(self._head)
        inner.addWidget(rule())
        inner.addWidget(self._across, 1)
        empty = QWidget()
        middle = QVBoxLayout(empty)
        words = label(EMPTY, "second")
        words.setAlignment(Qt.AlignmentFlag.AlignCenter)
        middle.addStretch(1)
        middle.addWidget(words)
        middle.addSpacing(12)
        middle.addWidget(self.begin, 0, Qt.AlignmentFlag.AlignCenter)
        middle.addStretch(1)
        self._stack = QStackedWidget()
        self._stack.addWidget(empty)
        self._stack.addWidget(whole)
        outer = QVBoxLayout(self)
        outer.setContentsMargins(0, 0, 0, 0)
        outer.addWidget(self._stack)

    def show_drawing(self, blueprint: Blueprint) -> None:
        """Take note of the drawing: a campaign of another version is dimmed."""
        self._blueprint = blueprint
        self.refresh()

    @property
    def is_another(self) -> bool:
        """Whether what is shown was made for another version of the drawing."""
        request = self._work.request
        return request is not None and request.blueprint is not self._blueprint

    def refresh(self) -> None:
        """Show how far the campaign is."""
        work, request = self._work, self._work.request
        shown = request is not None and (bool(work.tally.cells) or work.moves)
        self._stack.setCurrentIndex(int(shown))
        self.setFocusProxy(self.table if shown else self.begin)
        if request is None or not shown:
            return
        tally = work.tally
        self.done.setText(f"{tally.done:,} of {tally.every:,} runs" if tally.cells else "Preparing")
        self.bar.setRange(0, tally.every)
        self.bar.setValue(tally.done)
        self.words.setText(self._told())
        self.rates.setEnabled(tally.done > 0 and tally.faults != ("",) and not self.is_another)
        self.table.show_tally(tally, request.blueprint)
        self.table.show_pale(self.is_another)
        self._show_foresight()
        self._show_cell()

    def _show_foresight(self) -> None:
        self.table.show_only(self.differ.isChecked())
        count = len(self.table.atlas.differing)
        words = f"Prediction and outcome differ  {count}"
        if self.differ.text() != words:
            self.differ.setText(words)
            self.differ.setAccessibleName(words)
        self.differ.setEnabled(self._work.tally.faults not in ((), ("",)))

    def _open_finding(self) -> None:
        cell = self.table.chosen
        if cell is not None:
            self.finding_wanted.emit(cell)

    def _told(self) -> str:
        work, request = self._work, self._work.request
        assert request is not None
        told = [PHASES.get(work.phase, "")]
        if work.left is not None:
            told.append(f"{duration(work.left)} left")
        if request.dask:
            told.append(f"Dask {request.dask}")
        if request.agents:
            told.append(f"supervised by {' and '.join(request.agents)}")
        if work.left_out:
            told.append(f"without {', '.join(work.left_out)}: no operation names its parameters")
        if work.digest:
            told.append(f"digest {work.digest[:4]} {work.digest[4:8]}")
        if self.is_another:
            told.append(ANOTHER)
        return ", ".join(one for one in told if one)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.table.set_tokens(tokens)
        self.side.set_tokens(tokens)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Let Enter in the table go to the runs of the chosen cell."""
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter) and self.table.hasFocus():
            self.side.runs.setFocus()
            return
        super().keyPressEvent(event)

    def _show_cell(self) -> None:
        request = self._work.request
        cell = self.table.chosen
        self.side.show_cell(cell, request.blueprint if request is not None else None)
        self.side.show_foreseen(cell)

    def _replay(self, seed: int) -> None:
        if self.table.chosen is not None:
            self.replay_wanted.emit(self.table.chosen, seed)

    def _tell_story(self, seed: int) -> None:
        if self.table.chosen is not None:
            self.story_wanted.emit(self.table.chosen, seed)


def duration(seconds: float) -> str:
    """Return a time in words, coarse as an estimate is."""
    if seconds < 90:
        return f"{max(round(seconds), 1)} s"
    minutes = seconds / 60
    return f"{minutes:.0f} min" if minutes < 90 else f"{minutes / 60:.1f} h"


def _button(words: str, tip: str) -> QPushButton:
    button = QPushButton(words)
    button.setToolTip(tip_text(tip))
    return button
