"""Step in: veto, prune, take over and give back, and the box that asks for confirmation."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QVBoxLayout, QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.execution.status import DispatchStatus
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import label
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.features.supervise.buttons import StepInButton
from smsl_studio.studio.running import decisions
from smsl_studio.studio.running.confirmation import ConfirmBox
from smsl_studio.studio.running.decisions import Decision

OVER = ("", "opening", "idle", "done", "finished")
LOCKED = "automation is locked out"
NOBODY_MOVES = ("stopped", "taken_over")
HAND = 2
"""The place of the last button, below the heading and the other two."""


class StepIn(QWidget):
    """The commands about the next or the chosen operation."""

    wanted = Signal(object)
    """Decision: ask for its confirmation."""
    turned = Signal(bool)
    """bool: whether a person has control now. Then the button ``hand`` gives it back."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self.setAccessibleName("Step in")
        self.asking = ConfirmBox(anywhere=True)
        self.taken = False
        """Whether a person has control."""
        self._status: DispatchStatus | None = None
        self._subject: Address | None = None
        self._on = label("", "second")
        self._on.setMinimumWidth(40)
        veto, prune, hand = COMMANDS["veto"], COMMANDS["prune"], COMMANDS["take_over"]
        self.veto = StepInButton(veto.label, veto.key, veto.icon, tokens)
        self.prune = StepInButton(prune.label, prune.key, prune.icon, tokens)
        self.hand = StepInButton(hand.label, hand.key, hand.icon, tokens, LOCKED)
        self.veto.clicked.connect(self.ask_veto)
        self.prune.clicked.connect(self.ask_prune)
        self.hand.clicked.connect(self.ask_hand)
        self._detour = label("", "small")
        self._detour.setWordWrap(True)
        self._why, self._told = label("", "refusal"), label("", "small")
        self._told.setWordWrap(True)
        first = QHBoxLayout()
        first.addWidget(label("Step in", "heading"))
        first.addStretch(1)
        first.addWidget(self._on)
        both = QHBoxLayout()
        both.setSpacing(8)
        both.addWidget(self.veto)
        both.addWidget(self.prune)
        column = self._column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(8)
        column.addLayout(first)
        column.addLayout(both)
        for part in (self.hand, self.asking, self._why, self._told, self._detour):
            column.addWidget(part)
        self._why.hide()
        self._told.hide()

    @property
    def detour(self) -> str:
        """The sentence about the route after a veto."""
        return self._detour.text()

    @property
    def refusal(self) -> str:
        """Why the last command could not be done; empty if it could."""
        return "" if self._why.isHidden() else self._why.text()

    @property
    def told(self) -> str:
        """What was done last; empty if something else was asked since."""
        return "" if self._told.isHidden() else self._told.text()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        for button in (self.veto, self.prune, self.hand):
            button.set_tokens(tokens)

    def set_narrow(self, narrow: bool) -> None:
        """In a narrow column the buttons leave out their keys, which their tooltips have."""
        for button in (self.veto, self.prune, self.hand):
            button.set_narrow(narrow)

    def put_hand(self, place: QVBoxLayout | None) -> None:
        """Put the button ``hand`` into another layout. None puts it back to its place."""
        if place is None:
            self._column.insertWidget(HAND, self.hand)
        else:
            place.addWidget(self.hand)

    def show_status(
        self,
        blueprint: Blueprint | None,
        status: DispatchStatus | None,
        exists: bool,
        subject: Address | None,
    ) -> None:
        """Show the present state of the run.

        ``subject`` is the operation that a veto or a prune is about.
        """
        self._status = status if exists else None
        self._subject = subject if exists else None
        whole = f"on {subject.operation}" if self._subject and subject else ""
        metrics = self._on.fontMetrics()
        self._on.setText(
            metrics.elidedText(plain_text(whole), Qt.TextElideMode.ElideMiddle, self.width() - 90)
        )
        self._on.setToolTip(tip_text(str(self._subject or "")))
        for button, why in (
            (self.veto, self._no_veto()),
            (self.prune, self._no_prune()),
            (self.hand, self._no_hand()),
        ):
            button.setEnabled(not why)
            button.setToolTip(tip_text(why))
        taken = self._status is not None and self._status.phase == "taken_over"
        hand = COMMANDS["give_back" if taken else "take_over"]
        self.hand.set_words(hand.label, "the scene is read first" if taken else LOCKED, hand.icon)
        why = self.refusal.rstrip(".")
        if why and self._status is not None and why in self._status.sentence:
            # The hold card above already gives the reason.
            self.say("")
        item = decisions.possible(self._subject, status) if status is not None else None
        if item is not None and item.pruned:
            restore = COMMANDS["restore"]
            self.prune.set_words(f"{restore.label}…", "", restore.icon)
        else:
            self.prune.set_words(COMMANDS["prune"].label, "", COMMANDS["prune"].icon)
        said = ""
        if self._status is not None and blueprint is not None:
            said = decisions.detour_words(blueprint, self._status, subject)
        self._detour.setText(said)
        self._detour.setVisible(bool(said))
        if taken != self.taken:
            self.taken = taken
            self.turned.emit(taken)

    def ask_veto(self) -> None:
        """Ask for confirmation of a veto; if it is not possible, show why."""
        self._want(self._no_veto(), lambda: decisions.veto(*self._about()))

    def ask_prune(self) -> None:
        """Ask for confirmation of a prune; if it is not possible, show why."""
        self._want(self._no_prune(), lambda: decisions.prune(*self._about()))

    def ask_hand(self) -> None:
        """Ask whether to take over, or to give back after that."""
        taken = self._status is not None and self._status.phase == "taken_over"
        word = "give_back" if taken else "take_over"
        self._want(self._no_hand(), lambda: decisions.decision(word))

    def say(self, why: str) -> None:
        """Show why something was not done; empty hides the sentence."""
        self._why.setText(why)
        self._why.setVisible(bool(why))
        self._told.hide()

    def forget_refusal(self) -> None:
        """Hide why something was not done; what was done stays."""
        self._why.hide()

    def tell(self, done: str) -> None:
        """Show what was done, until something else is asked."""
        self.say("")
        self._told.setText(done)
        self._told.show()

    def _want(self, why: str, make: object) -> None:
        self.say(why)
        if not why and callable(make):
            decision = make()
            assert isinstance(decision, Decision)
            self.wanted.emit(decision)

    def _about(self) -> tuple[Address, DispatchStatus]:
        assert self._subject is not None
        assert self._status is not None
        return self._subject, self._status

    def _no_veto(self) -> str:
        if self._no_hand():
            return self._no_hand()
        assert self._status is not None
        if self._status.phase in NOBODY_MOVES:
            return "Nothing is about to move."
        return "" if self._subject else "No operation is next. Choose one with 1 to 9."

    def _no_prune(self) -> str:
        """A stopped run takes it too, and keeps it when it goes on."""
        if self._no_run():
            return self._no_run()
        return "" if self._subject else "No operation is next. Choose one with 1 to 9."

    def _no_run(self) -> str:
        there = self._status is not None and self._status.phase not in OVER
        return "" if there else "No run is there to step into."

    def _no_hand(self) -> str:
        if self._no_run():
            return self._no_run()
        return "The run is stopped. Reset it, or end it." if self._stopped() else ""

    def _stopped(self) -> bool:
        return self._status is not None and self._status.phase == "stopped"
