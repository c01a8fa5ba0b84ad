"""The board of the partial view: the previous state, the active state, its operations, their
targets."""

from __future__ import annotations

from PySide6.QtCore import QPoint, QRect, Qt, QTimer, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QFrame, QScrollArea, QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.views.partial import PartialView
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.supervise.card import CardButton, CardForecast
from smsl_studio.studio.features.supervise.columns import Columns
from smsl_studio.studio.features.supervise.spot import StateSpot
from smsl_studio.studio.features.supervise.surface import PartialSurface
from smsl_studio.studio.features.supervise.wires import LIT


class Board(QScrollArea):
    """Scrolls if there are more operations than room; the states stay visible."""

    card_chosen = Signal(object)
    """Address: the person pressed the card of this operation."""
    state_chosen = Signal(str)
    """str: the person clicked on this state."""
    columns_moved = Signal(object)
    """Columns: the present places of the columns."""

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._inner = PartialSurface(tokens)
        self._at_hand: Address | None = None
        self._chosen: Address | None = None
        self._inner.card_chosen.connect(self.card_chosen)
        self._inner.state_chosen.connect(self.state_chosen)
        self._inner.seen_wanted.connect(self._see)
        self.setWidget(self._inner)
        self.setWidgetResizable(True)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setAccessibleName("Partial view")
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        for bar in (self.verticalScrollBar(), self.horizontalScrollBar()):
            bar.valueChanged.connect(lambda _: self._follow())

    @property
    def inner(self) -> QWidget:
        """The widget that scrolls, with cards and states on it."""
        return self._inner

    @property
    def cards(self) -> list[CardButton]:
        """The cards in order."""
        return self._inner.cards

    @property
    def view(self) -> PartialView | None:
        """The partial view that is shown; None if there is none."""
        return self._inner.view

    @property
    def columns(self) -> Columns | None:
        """The places of the columns; None if there are none."""
        return self._inner.columns

    @property
    def shift(self) -> int:
        """How far the board is scrolled to the right (pixels)."""
        return self.horizontalScrollBar().value()

    @property
    def spots(self) -> list[StateSpot]:
        """The visible states: the previous one, the active one, the targets."""
        return self._inner.shown_spots()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._inner.set_tokens(tokens)

    def show_view(
        self,
        blueprint: Blueprint | None,
        view: PartialView | None,
        chosen: Address | None,
        sensed: tuple[tuple[int, str], ...] = (),
    ) -> None:
        """Show one SB.

        ``chosen`` is the operation of an open decision. ``sensed`` lists facts of the active state
        as (digit, "differs" or "unknown").
        """
        self._inner.show_view(blueprint, view, chosen, sensed)
        self._follow()
        hand = self._hand()
        at_hand = hand.card.address if hand is not None else None
        if at_hand != self._at_hand:
            self._at_hand = at_hand
            # The board has the height of its new cards a moment later.
            QTimer.singleShot(0, self, self._see_hand)
        if chosen != self._chosen:
            self._chosen = chosen
            # It may have been chosen by its number or in the text.
            QTimer.singleShot(0, self, self._see_chosen)

    def show_selected(self, states: frozenset[str]) -> None:
        """Ring these of the states to which the operations lead."""
        self._inner.show_selected(states)

    def show_forecast(self, told: CardForecast | None) -> None:
        """Show a forecast on the card of its operation. None takes the words away."""
        self._inner.show_forecast(told)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep the states in the middle of the visible part."""
        super().resizeEvent(event)
        self._follow()

    def _follow(self) -> None:
        corner = QPoint(self.horizontalScrollBar().value(), self.verticalScrollBar().value())
        self._inner.set_window(QRect(corner, self.viewport().size()))
        found = self._inner.columns
        if found is not None:
            self.columns_moved.emit(found)

    def _hand(self) -> CardButton | None:
        """The card of the operation that is proposed or under way; None without one."""
        return next((one for one in self.cards if one.card.standing in LIT), None)

    def _see_hand(self) -> None:
        """Scroll to the operation at hand, once. A person may scroll away from it."""
        hand = self._hand()
        if hand is not None:
            self._see(hand)

    def _see_chosen(self) -> None:
        """Scroll to the operation that was chosen, once."""
        for one in self.cards:
            if one.card.address == self._chosen:
                self._see(one)

    def _see(self, card: QWidget) -> None:
        self.ensureWidgetVisible(card, 0, 12)
