"""The panel Possible now: the list, the card of a run that holds, and the question about
pruning."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QVBoxLayout, QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.front.views.phase_words import LATCHED
from smsl_studio.front.views.possible_rows import PossibleRow
from smsl_studio.studio.base.announcement import announce
from smsl_studio.studio.base.room import Room
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.running import decisions
from smsl_studio.studio.running.confirmation import ConfirmBox
from smsl_studio.studio.running.decisions import Decision
from smsl_studio.studio.running.hold_card import HoldCard
from smsl_studio.studio.running.possible_list import PRUNABLE, PossibleList
from smsl_studio.studio.running.run_session import RunSession


class PossiblePanel(QWidget):
    """The list of possible operations.

    Above it are the hold card and the confirmation of a decision.
    """

    chosen = Signal(object)
    """Address: the person chose this permitted operation."""

    def __init__(self, run: RunSession, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setProperty("role", "panel")
        self._run = run
        self.list = PossibleList(tokens)
        self.hold, self.asking = HoldCard(brief=True), ConfirmBox()
        self._gone = ""
        inset = QVBoxLayout()
        inset.setContentsMargins(8, 8, 8, 0)
        inset.setSpacing(8)
        inset.addWidget(self.hold)
        inset.addWidget(self.asking)
        inner = QWidget()
        inner.setLayout(inset)
        # It scrolls, so that it does not push the panels around it away.
        self._above = Room(inner)
        self._above.hide()
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self._above)
        column.addWidget(self.list, 1)
        # In a low panel the list gives way, because the card has what must be done next.
        self.list.setMinimumHeight(1)
        self.list.chosen.connect(self.chosen)
        self.list.restore_wanted.connect(run.restore)
        self.list.prune_wanted.connect(self._ask_prune)
        self.hold.wanted.connect(self.ask)
        self.hold.way_wanted.connect(run.way_wanted)
        self.asking.confirmed.connect(self._do)
        self.asking.dropped.connect(self._fit)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.list.set_tokens(tokens)

    def show_rows(self, rows: tuple[PossibleRow, ...], by_hand: bool, empty: str) -> None:
        """Show the rows.

        ``by_hand`` says whether they can be chosen, ``empty`` is shown without rows.
        """
        decision, status = self.asking.decision, self._run.status
        open_ones = [row.address for row in rows if row.kind in PRUNABLE]
        if decision is not None and status is not None and self._run.exists:
            # Somebody may be typing the reason, so the run that goes on takes no prune away.
            if (
                (decision.command == "prune" and status.phase not in LATCHED)
                or decision.address in open_ones
                or self._offers(decision)
            ):
                self.asking.show_decision(decisions.followed(decision, status))
            else:
                self.asking.show_decision(None)
        else:
            if decision is not None and self._run.over:
                self._gone = decisions.gone_words(decision)
                announce(self, self._gone, urgent=True)
            self.asking.show_decision(None)
        if self._run.exists:
            self._gone = ""
        self._fit()
        self.list.show_rows(rows, by_hand, f"{empty} {self._gone}".strip())

    def row_widgets(self) -> list[QWidget]:
        """The widgets of the rows in order."""
        return self.list.row_widgets()

    def _ask_prune(self, address: Address) -> None:
        status = self._run.status
        if status is not None:
            self.ask(decisions.prune(address, status))

    def ask(self, decision: Decision) -> None:
        """Ask for confirmation of a decision; Enter confirms, as in Supervise mode."""
        self.asking.show_decision(decision)
        self._fit()
        self.asking.take_focus()

    def _offers(self, decision: Decision) -> bool:
        """Whether the decision is still among the offers of a run that holds or is stopped."""
        status = self._run.status
        if status is None or not self._run.exists:
            return False
        return (decision.command, decision.address) in [
            (one.command, one.address) for one in map(decisions.offered, decisions.offers(status))
        ]

    def _do(self, decision: Decision, reason: str = "") -> None:
        self.asking.show_decision(None)
        self.list.setFocus()
        self._run.take(decision.said(reason))
        self._fit()

    def _fit(self) -> None:
        if self.asking.decision is None:
            self.hold.show_status(self._run.status, self._run.exists)
        else:
            # The question takes the place of the card that led to it, so that it is visible.
            self.hold.hide()
        self._above.setVisible(not self.hold.isHidden() or not self.asking.isHidden())
