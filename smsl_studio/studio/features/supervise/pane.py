"""The body of Supervise mode: the partial view, the state check, and the column Step in."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QEvent, Qt, Signal
from PySide6.QtGui import QKeyEvent, QResizeEvent, QShowEvent
from PySide6.QtWidgets import (
    QVBoxLayout,
    QWidget,
)

from smsl_studio.blueprint.address import Address
from smsl_studio.dispatch.drive.foresight import sensed_values
from smsl_studio.front.views.partial import PartialView, partial_view, shown_branch
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import refusal_words
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.supervise.bar import SuperviseBar
from smsl_studio.studio.features.supervise.check_panel import CheckPanel
from smsl_studio.studio.features.supervise.decision_flow import DecisionFlow
from smsl_studio.studio.features.supervise.fact_choice import NOTHING, FactChoice
from smsl_studio.studio.features.supervise.forecast_strip import ForecastStrip
from smsl_studio.studio.features.supervise.graph_column import GraphColumn
from smsl_studio.studio.features.supervise.keys import press
from smsl_studio.studio.features.supervise.large_view import LargeView
from smsl_studio.studio.features.supervise.large_words import LargeRun, large_words
from smsl_studio.studio.features.supervise.right_column import RightColumn
from smsl_studio.studio.features.supervise.seen_parts import SeenParts
from smsl_studio.studio.features.supervise.splits import Rolled, column_of, split_of
from smsl_studio.studio.features.supervise.step_in import StepIn
from smsl_studio.studio.features.supervise.text_panel import TextPanel
from smsl_studio.studio.running import decisions
from smsl_studio.studio.running.hold_card import HoldCard
from smsl_studio.studio.running.run_session import ENDABLE, RunSession
from smsl_studio.studio.running.world_pane import WorldPane

RIGHT = 396
NARROW, LOW_PAGE, TWO = 900, 420, 640
"""A page narrower than the first has a narrow column at the right, one lower than the second
scrolls at the left; below the third the panels below stand below each other (pixels)."""
LOW_RIGHT = 520
"""A page lower than this scrolls at the right, because a question has no room above Step in."""
BELOW = 246
"""The designed height of the panels below the partial view (pixels)."""


class SupervisePane(QWidget):
    """Shows the run of this window and sends it the supervisor's commands.

    ``task_slot`` and ``level_slot`` are layouts for the task card and the panel of levels.
    ``room_changed`` tells how high the task card may be.
    """

    begin_wanted = Signal()
    """The person wants to start a run."""
    low_changed = Signal(bool)
    """bool: whether the page is now so low that the column at the right scrolls."""

    def __init__(
        self, session: Session, run: RunSession, tokens: Tokens, parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self._session, self._run, self._tokens = session, run, tokens
        self._chosen_branch = self._branch = ""
        self.remember_large: Callable[[str], object] = lambda _: None
        self._view: PartialView | None = None
        self.setAccessibleName("Supervise")
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        # With a parent it is freed with the pane, also if the mode is never shown.
        self.bar = SuperviseBar(tokens, self)
        self.bar.hide()
        self.graph = graph = GraphColumn(session, run, tokens)
        self.head, self.board, self.pages = graph.head, graph.board, graph.pages
        self.full_map, self.notice = graph.full_map, graph.notice
        self.check, self.forecast = CheckPanel(tokens), ForecastStrip(tokens)
        self.forecaster = run.forecaster
        self.text, self.scene = TextPanel(tokens), WorldPane(run, tokens, watches=True)
        self.hold, self.step_in = HoldCard(), StepIn(tokens)
        self._wearing = (self.bar, self.graph, self.check, self.step_in, self.forecast, self.text,
                         self.scene)  # fmt: skip
        self.deciding = DecisionFlow(run, self.step_in, self)
        self._build()
        self.facts = FactChoice(run, self.board, self.text, self.scene, self.check.table)
        self._connect()
        self.refresh()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        for part in (*self._wearing, self.seen, self.large):
            part.set_tokens(tokens)
        self.refresh()

    # What others ask of it.

    @property
    def view(self) -> PartialView | None:
        """The partial view that is shown; None if there is none."""
        return self._view

    @property
    def subject(self) -> Address | None:
        """The operation that a veto or a prune is about: the chosen one, else the next.

        None for none.
        """
        status = self._run.status
        if self._view is not None and self._view.card(self.deciding.picked) is not None:
            return self.deciding.picked
        if status is None or not self._run.exists:
            return None
        return status.running or status.carrying or next(iter(status.route), None)

    def choose(self, number: int) -> None:
        """Choose the operation with this number key; Enter confirms."""
        card = self._view.numbered(number) if self._view is not None else None
        if card is not None and self._run.exists:
            self.pick(card.address)

    def pick(self, address: Address) -> None:
        """Choose an operation and ask what to do with it."""
        card = self._view.card(address) if self._view is not None else None
        if card is not None and self._run.exists:
            self.facts.choose_changed(address)
            self.deciding.pick(card)

    def accept(self) -> None:
        """Ask whether to accept the located state, if there is one."""
        status = self._run.status
        if status is not None and self.is_located():
            self.deciding.ask(decisions.accept(status))

    def set_full_map(self, on: bool) -> None:
        """Show or hide the full map of the SB. The run's record notes that it was looked at."""
        if self._run.exists:
            self._run.full_map(on)
            if on:
                self.full_map.show_branch(self._branch)

    def show_branch(self, name: str) -> None:
        """Show this SB from now on, even if an operation runs in another one."""
        self._chosen_branch = name
        self.deciding.drop()
        self.refresh()

    # What the actions need.

    def run_exists(self) -> bool:
        """Whether there is a run."""
        return self._run.exists

    def is_located(self) -> bool:
        """Whether the facts of a run that was taken over fit exactly one configuration."""
        status = self._run.status
        taken = status is not None and status.phase == "taken_over"
        return taken and status is not None and len(status.candidates) == 1

    def is_stopped(self) -> bool:
        """Whether the run is stopped."""
        return self._run.exists and self._run.phase == "stopped"

    def is_held(self) -> bool:
        """Whether the run is stopped, or holds after a fault or without a route."""
        return self._run.exists and self._run.phase in ENDABLE

    def is_mapped(self) -> bool:
        """Whether the full map of the SB is shown."""
        return self._run.exists and self._run.status is not None and self._run.status.full_map

    def choose_first(self) -> None:
        """Give the keyboard focus to the first card."""
        if self.board.cards:
            self.board.cards[0].setFocus()

    def ask_for(self, word: str) -> None:
        """Ask for confirmation of the command with this word."""
        own = {
            "veto": self.step_in.ask_veto,
            "prune": self.step_in.ask_prune,
            "take_over": self.step_in.ask_hand,
            "give_back": self.step_in.ask_hand,
            "accept": self.accept,
            "full_map": self.turn_map,
        }
        ask = own.get(word)
        if ask is not None:
            ask()
        elif word == "end":
            self.deciding.ask(decisions.end(held=self.is_held()))
        elif word == "reset":
            self.deciding.ask(decisions.way_out(word))
        elif self._run.exists:
            self.deciding.ask(decisions.decision(word))

    def turn_map(self) -> None:
        """Switch the full map on or off."""
        self.set_full_map(not self.is_mapped())

    # Building.

    def _build(self) -> None:
        self.seen = SeenParts(self._run, self.graph, self.text, self.scene, self._tokens)
        self.bar.views.setMenu(self.seen.menu)
        self.large = LargeView(self._tokens)
        self.large.hide()
        beside = split_of(Qt.Orientation.Horizontal, self.large, self.seen)
        beside.setStretchFactor(1, 1)
        top = column_of(None, beside, self.forecast)
        self.level_slot = QVBoxLayout()
        self.level_slot.setContentsMargins(0, 0, 0, 0)
        level = QWidget()
        level.setProperty("role", "panel")
        level.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        level.setLayout(self.level_slot)
        self.below = split_of(Qt.Orientation.Horizontal, self.check, level)
        self.below.setSizes([583, 424])
        self.level = level
        level.hide()
        left = split_of(Qt.Orientation.Vertical, top, self.below)
        left.setStretchFactor(0, 1)
        left.setSizes([560, BELOW])
        self._right = RightColumn(self.hold, self.step_in)
        self.task_slot, self.room_changed = self._right.task_slot, self._right.room_changed
        self._sides = split_of(Qt.Orientation.Horizontal, Rolled(left), self._right)
        self._sides.setStretchFactor(0, 1)
        self._sides.setSizes([1044, RIGHT])
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self._sides)

    def add_levels(self, widget: QWidget) -> None:
        """Put the panel of levels beside the state check."""
        self.level_slot.addWidget(widget)
        self.level.show()

    def _connect(self) -> None:
        run, bar = self._run, self.bar
        run.changed.connect(self.refresh)
        self._session.blueprint_changed.connect(lambda *_: self.refresh())
        run.refused.connect(lambda error: self.notice.say(refusal_words(error)))
        self.board.card_chosen.connect(self.pick)
        self.text.chosen.connect(self.pick)
        for turned in (self.text.turned, self.seen.turned):
            turned.connect(self.refresh)
        self.full_map.chosen.connect(self.pick)
        self.facts.changed.connect(self.refresh)
        asking = self.step_in.asking
        for over in (asking.dropped, asking.confirmed):
            # What a question is about is chosen with it, and no longer than it.
            over.connect(lambda *_: self.facts.choose(NOTHING))
        self.head.branch_wanted.connect(self.show_branch)
        self.head.map_wanted.connect(self.set_full_map)
        self.deciding.changed.connect(self.refresh)
        self.deciding.changed.connect(self._right.see_question)
        self.hold.wanted.connect(self.deciding.ask)
        self.forecaster.changed.connect(self._show_forecast)
        self.forecast.anew_wanted.connect(lambda: self.forecaster.anew(run.status))
        self.notice.pressed.connect(self.begin_wanted)
        self.seen.large_wanted.connect(self.set_large)
        bar.play_wanted.connect(lambda: run.resume() if run.exists else self.begin_wanted.emit())
        bar.pause_wanted.connect(run.pause)
        bar.stop_wanted.connect(run.stop)
        bar.reset_wanted.connect(lambda: self.ask_for("reset"))
        bar.end_wanted.connect(lambda: self.ask_for("end"))

    @property
    def is_large(self) -> bool:
        """Whether the large layout is shown, which is read from two metres."""
        return not self.large.isHidden()

    def turn_large(self) -> None:
        """Show the large layout, or the usual one again."""
        self.set_large(not self.is_large)

    def drop(self) -> None:
        """Drop the question and what is chosen."""
        self.facts.choose(NOTHING)
        self.deciding.drop()

    def confirm(self) -> bool:
        """Confirm the present question; returns whether there is one."""
        return self.deciding.confirm()

    def set_large(self, on: bool) -> None:
        """Show the large layout, or the usual one again. It is remembered."""
        self.large.setVisible(on)
        self.seen.set_large(on)
        self.below.setVisible(not on)
        self.forecast.setVisible(not on)
        self.remember_large("large" if on else "")
        self.refresh()

    # What is shown.

    def refresh(self) -> None:
        """Show the present state of the run."""
        run, status, blueprint = self._run, self._run.status, self._run.blueprint
        branch = ""
        self._view = None
        if status is not None and blueprint is not None:
            branch = shown_branch(status, self._chosen_branch, self._branch)
            self._branch = branch
            self._view = partial_view(blueprint, status, branch)
        self.bar.show_status(run)
        if not self.isVisible() and self.seen.own is None:
            return
        self.deciding.follow(status, self._view)
        self.graph.show_view(self._view, branch, self.deciding.picked)
        self.check.show_status(
            blueprint, status, self._view, run.phase == "failed", over=not run.exists
        )
        self.hold.show_status(status, run.exists)
        self.step_in.show_status(blueprint, status, run.exists, self.subject)
        self.forecaster.follow(run.asked, status, self.subject)
        self.seen.refresh()
        self.facts.follow(status, self._view)
        self._show_forecast()

    def _show_forecast(self) -> None:
        run, status = self._run, self._run.status
        at_work = status is not None and (status.carrying or status.running) is not None
        now = sensed_values(status.scene) if status is not None else {}
        view = self.forecaster.view
        self.forecast.show_forecast(run.blueprint, view, now, at_work)
        told = self.forecast.card_words(run.blueprint)
        self.board.show_forecast(told)
        if self.is_large:
            self.forecast.hide()
            asking = self.step_in.asking
            asked = asking.words if asking.isVisible() else ""
            here = LargeRun(run.blueprint, status, run.phase, run.over, run.sentence, asked)
            self.large.show_words(large_words(here, self._view, self.subject, told))
        self.text.show_state(run.blueprint, self._view, self.subject, at_work)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Fit the columns to the new size."""
        super().resizeEvent(event)
        narrow, low = self.width() < NARROW, self.height() < LOW_RIGHT
        self._right.fit(narrow, low)
        self.low_changed.emit(low)
        left = self.width() - self._right.minimumWidth()
        way = Qt.Orientation.Vertical if left < TWO else Qt.Orientation.Horizontal
        if self.below.orientation() != way:
            self.below.setOrientation(way)
        if narrow:
            self._sides.setSizes([left, self._right.minimumWidth()])

    def showEvent(self, event: QShowEvent) -> None:
        """Show the present state of the run."""
        super().showEvent(event)
        self.refresh()

    # Keys.

    def event(self, event: QEvent) -> bool:
        """While something is asked, Esc drops the question, whatever else the window does on
        Esc."""
        before = event.type() is QEvent.Type.ShortcutOverride and self.step_in.asking.isVisible()
        if before and isinstance(event, QKeyEvent) and event.key() == Qt.Key.Key_Escape:
            event.accept()
            return True
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Answer the keys of supervision; a key that is held counts once."""
        plain = event.modifiers() in (
            Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.KeypadModifier,
        )  # fmt: skip
        if plain and not event.isAutoRepeat() and press(self, Qt.Key(event.key())):
            return
        super().keyPressEvent(event)
