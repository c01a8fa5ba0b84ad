"""The way of a decision: an operation is chosen, confirmed, and sent to the run."""

from __future__ import annotations

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QApplication, QWidget
from shiboken6 import isValid

from smsl_studio.blueprint.address import Address
from smsl_studio.dispatch.execution.status import DispatchStatus
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.front.views.partial import PRUNED, RISKY, VETOED, OperationCard, PartialView
from smsl_studio.front.views.phase_words import LATCHED
from smsl_studio.runlog.events import (
    Commanded,
    Event,
    OperationPruned,
    OperationRefused,
    OperationStarted,
    RunStarted,
)
from smsl_studio.studio.base.words import capital
from smsl_studio.studio.features.supervise.step_in import StepIn
from smsl_studio.studio.running import decisions
from smsl_studio.studio.running.decisions import Decision
from smsl_studio.studio.running.run_session import RunSession


class DecisionFlow(QObject):
    """Asks for confirmation in the box of Step in, and then commands the run.

    ``home`` gets the keyboard focus afterwards if the widget that had it is gone.
    """

    changed = Signal()
    """The chosen operation or the question changed."""

    def __init__(self, run: RunSession, step_in: StepIn, home: QWidget) -> None:
        super().__init__(home)
        self._run, self._step_in, self._home = run, step_in, home
        self._asking = step_in.asking
        self._came_from: QWidget | None = None
        self._let_be: object = None
        self.picked: Address | None = None
        step_in.wanted.connect(self.ask)
        step_in.asking.confirmed.connect(self._do)
        step_in.asking.dropped.connect(self.drop)
        run.events_told.connect(self._tell)

    def pick(self, card: OperationCard) -> None:
        """Choose an operation and ask what to do with it."""
        self.picked = card.address
        self.ask(decisions.choose(card))

    def ask(self, decision: Decision) -> None:
        """Ask for confirmation of a decision, with the keyboard focus on it."""
        if self._asking.decision is None:
            self._came_from = self._focus()
        self._step_in.say("")
        self._asking.show_decision(decision)
        self._asking.take_focus()
        self.changed.emit()

    def drop(self) -> None:
        """Cancel the question and the choice."""
        status = self._run.status
        self._let_be = status.candidates if status is not None else None
        self._asking.show_decision(None)
        self.picked = None
        self._step_in.say("")
        self._go_back()
        self.changed.emit()

    def confirm(self) -> bool:
        """Confirm the present question; returns whether there is one."""
        if self._asking.decision is None:
            return False
        self._asking.confirm()
        return True

    def follow(self, status: DispatchStatus | None, view: PartialView | None) -> None:
        """Update the question after a change of the run.

        A question that makes no sense any more is dropped. If the state was located, it asks
        whether to accept it.
        """
        if view is None or view.card(self.picked) is None:
            self.picked = None
        if self._run.exists and _tells(status, self._step_in.refusal):
            # The hold card above already gives the reason.
            self._step_in.say("")
        located = self._located(status)
        decision = self._asking.decision
        if decision is None:
            if located and status is not None and status.candidates != self._let_be:
                self._asking.show_decision(decisions.accept(status))
                self._came_from = self._focus()
                if self._came_from is not None:
                    # Else Enter, which stands at the question, would press the card of before.
                    self._asking.take_focus()
            return
        refused = _refused(decision, status)
        if refused:
            self._asking.show_decision(None)
            self._step_in.say(f'{capital(refused)} The question "{decision.sentence}" is gone.')
            self._go_back()
            return
        card = view.card(decision.address) if view is not None else None
        about_card = decision.command in ("ask", "")
        if (
            not self._run.exists
            or (about_card and card is None)
            or (decision.command == "accept" and not located)
        ):
            self._asking.show_decision(None)
            if self._run.over:
                self._step_in.say(decisions.gone_words(decision))
        elif (
            card is not None
            and card.address == self.picked
            and (about_card or _is_restored(decision, card))
        ):
            self._asking.show_decision(decisions.choose(card))
        elif status is not None:
            self._asking.show_decision(decisions.followed(decision, status))

    def _focus(self) -> QWidget | None:
        """The widget of the page that has the keyboard focus, None if none of them has it."""
        focus = QApplication.focusWidget()
        return focus if focus is not None and self._home.isAncestorOf(focus) else None

    def _located(self, status: DispatchStatus | None) -> bool:
        taken = status is not None and self._run.exists and status.phase == "taken_over"
        return taken and status is not None and len(status.candidates) == 1

    def _do(self, decision: Decision, reason: str) -> None:
        self._let_be = None
        self._asking.show_decision(None)
        if decision.command == "end":
            self._run.finish()
        else:
            self._run.take(decision.said(reason))
        self.picked = None
        self._go_back()
        self.changed.emit()

    def _go_back(self) -> None:
        """Return the keyboard focus to where it was before the question."""
        back, self._came_from = self._came_from, None
        there = back is not None and isValid(back) and back.isVisible()
        (back if back is not None and there else self._home).setFocus()

    def _tell(self, events: tuple[Event, ...]) -> None:
        """Show in Step in what the run refused, until another command is carried out."""
        for event in events:
            if isinstance(event, RunStarted | Commanded):
                self._step_in.say("")
            if isinstance(event, OperationStarted):
                # A second press of Step was refused before the first one had begun anything.
                self._step_in.forget_refusal()
            if isinstance(event, Commanded) and event.refused:
                self._step_in.say(capital(event.refused))
            elif isinstance(event, OperationRefused):
                self._step_in.say(" ".join(map(capital, event.reasons)))
            elif isinstance(event, OperationPruned):
                self._step_in.tell(f"Pruned: {event.address}. Restore lets it be used again.")


def _refused(decision: Decision, status: DispatchStatus | None) -> str:
    """Why the run would refuse now what the question asks; empty if it would not.

    The card of an operation tells that itself, and the end of a run is no command to it.
    """
    if status is None or decision.command in ("", "ask", "accept", "end"):
        return ""
    return COMMANDS[decision.command].why_refused(status.phase, status.by)


def _is_restored(decision: Decision, card: OperationCard) -> bool:
    """Whether the operation to be restored can already be used again."""
    return decision.command == "restore" and card.standing not in (PRUNED, RISKY, VETOED)


def _tells(status: DispatchStatus | None, refusal: str) -> bool:
    """Whether the sentence of the hold card contains the refusal."""
    if status is None or status.phase not in LATCHED or not refusal:
        return False
    return refusal.rstrip(".").casefold() in status.sentence.casefold()
