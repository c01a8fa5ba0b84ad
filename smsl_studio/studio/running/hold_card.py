"""The card that says why a run holds, edge by edge, and what can be done; hidden otherwise."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QFrame, QPushButton, QVBoxLayout, QWidget

from smsl_studio.dispatch.execution.status import DispatchStatus, Offer
from smsl_studio.front.views.hold_advice import hold_advice
from smsl_studio.front.views.phase_words import HOLDS, LATCHED, phase_words
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Label, label, row
from smsl_studio.studio.base.room import Room
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import as_it_is, capital
from smsl_studio.studio.running.decisions import Decision, offered, offers

WAY = "Let somebody propose operations of the library. You allow each, for this run only"
BUTTON = 132
WIDEST, AROUND = 280, 30
"""Largest width of a button with a long name, and what a button needs beside its words (pixels)."""
NARROW = 280
"""In a card narrower than this what a button does stands below it (pixels)."""
MOST = 180
"""Largest height of the list of reasons; a longer list scrolls (pixels)."""


class HoldCard(QFrame):
    """Reasons and offers of a run that waits for a person's decision."""

    wanted = Signal(object)
    """Decision: the person pressed the button of an offer."""
    way_wanted = Signal()
    """The person wants a provider to propose operations that lead on."""

    def __init__(self, brief: bool = False) -> None:
        """``brief`` leaves out the reasons, if another widget shows them."""
        super().__init__()
        self._brief = brief
        self.setObjectName("holdCard")
        self.setAccessibleName("Why it holds")
        self._heading, self._sentence = label("", "strong"), label("", "small")
        self._sentence.setWordWrap(True)
        self._details = Label()
        self._details.setProperty("role", "small")
        self._details.setWordWrap(True)
        self._details.setAlignment(Qt.AlignmentFlag.AlignTop)
        inner = QWidget()
        rows = QVBoxLayout(inner)
        rows.setContentsMargins(0, 0, 0, 0)
        rows.addWidget(self._details)
        self._room = Room(inner)
        self._room.setMaximumHeight(MOST)
        self._buttons = QVBoxLayout()
        self._buttons.setSpacing(6)
        self._shown: tuple[Offer, ...] = ()
        self._below = False
        column = QVBoxLayout(self)
        column.setContentsMargins(12, 10, 12, 12)
        column.setSpacing(6)
        self._advice = label("", "hint")
        self._advice.setWordWrap(True)
        for part in (self._heading, self._sentence, self._room, self._advice):
            column.addWidget(part)
        column.addLayout(self._buttons)
        self.way = QPushButton("Ask for a way…")
        self.way.setToolTip(tip_text(WAY))
        self.way.clicked.connect(self.way_wanted)
        self._way = QWidget()
        self.way.setFixedWidth(BUTTON)
        line = row(self.way, spacing=8)
        line.setContentsMargins(0, 0, 0, 0)
        line.addWidget(label("Operations of the library are proposed; you allow each.", "hint"), 1)
        self._way.setLayout(line)
        column.addWidget(self._way)
        self.hide()

    @property
    def details(self) -> str:
        """The reasons, one in each line; empty while the card is hidden."""
        return "" if self.isHidden() else self._details.text()

    @property
    def advice(self) -> str:
        """The advice of the card. It is empty if there is none."""
        return "" if self.isHidden() else self._advice.text()

    def buttons(self) -> list[QPushButton]:
        """The buttons of the offers, in their order."""
        found = [] if self.isHidden() else self.findChildren(QPushButton)
        return [one for one in found if one is not self.way]

    def show_status(self, status: DispatchStatus | None, exists: bool) -> None:
        """Show the present state of a run."""
        held = status is not None and exists and status.phase in LATCHED
        self.setVisible(held)
        if status is None or not held:
            self._offer(())
            return
        words, kind = phase_words(status.phase)
        words = HOLDS.get(status.reason, words) if status.phase == "fault_hold" else words
        self._heading.setText(words + (f" by {status.by}" if status.by else ""))
        sentence = capital(status.sentence)
        if sentence == f"{self._heading.text()}.":
            sentence = ""
        if status.phase == "taken_over":
            sentence = "The automation is locked out and only observes. Give it back with T."
        self._sentence.setText(sentence)
        self._sentence.setVisible(bool(sentence) and not self._brief)
        reasons = [_plain(one) for one in status.details if one not in sentence]
        self._details.setText("\n".join(reasons))
        self._room.setVisible(bool(reasons) and not self._brief)
        self._advice.setText(hold_advice(status))
        self._advice.setVisible(bool(self._advice.text()))
        self._offer(offers(status))
        self._way.setVisible(status.phase == "no_route")
        if self.property("kind") != kind:
            self.setProperty("kind", kind)
            self.style().unpolish(self)
            self.style().polish(self)

    def _offer(self, found: Sequence[Offer]) -> None:
        told = (tuple(found), self.width() < NARROW)
        if told == (self._shown, self._below):
            return
        self._shown, self._below = told
        while self._buttons.count():
            item = self._buttons.takeAt(0)
            old = item.widget() if item else None
            if old is not None:
                old.hide()
                old.setParent(None)
                old.deleteLater()
        for offer in self._shown:
            self._buttons.addWidget(self._row(offered(offer)))

    def _row(self, decision: Decision) -> QWidget:
        """A button, and beside it what the button does."""
        line = QWidget()
        button = QPushButton()
        button.ensurePolished()
        metrics = button.fontMetrics()
        middle, verb = Qt.TextElideMode.ElideMiddle, plain_text(decision.verb)
        needed = metrics.horizontalAdvance(verb) + AROUND
        whole = needed <= BUTTON
        wide = BUTTON if whole else min(WIDEST, needed)
        button.setText(as_it_is(metrics.elidedText(verb, middle, wide - AROUND + 2)))
        button.setFixedWidth(wide)
        button.setAccessibleName(plain_text(decision.verb))
        button.setToolTip(tip_text(f"{decision.verb}: {decision.detail}"))
        button.clicked.connect(lambda _=False: self._want(decision))
        said = label(decision.detail, "hint")
        across = row(button)
        if not whole or self.width() < NARROW:
            # A long button takes the whole line, and the explanation stands below, as it does in
            # a narrow card.
            across.addStretch(1)
            both = QVBoxLayout(line)
            both.setContentsMargins(0, 0, 0, 0)
            both.setSpacing(2)
            both.addLayout(across)
            both.addWidget(said)
            return line
        across.addWidget(said, 1)
        line.setLayout(across)
        return line

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Put the explanations below their buttons where the card is narrow."""
        super().resizeEvent(event)
        self._offer(self._shown)

    def _want(self, decision: Decision) -> None:
        self.wanted.emit(decision)


def _plain(detail: str) -> str:
    """A reason that names its edge only once.

    ``SB/State/Op is pruned`` in place of ``SB/State/Op: SB/State/Op is pruned``.
    """
    edge, colon, why = detail.partition(": ")
    return why if colon and why.startswith(f"{edge} ") else detail
