"""The scrolled surface of the partial view: cards and states as widgets, wires painted behind."""

from __future__ import annotations

from dataclasses import replace

from PySide6.QtCore import QPointF, QRect, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import QLabel, QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.views.partial import OperationCard, PartialView
from smsl_studio.legible import plain_text
from smsl_studio.picture.picture import Face, Picture
from smsl_studio.studio.base.controls import Label
from smsl_studio.studio.base.paint.ink import Ink, Type, draw_sub_mark
from smsl_studio.studio.base.paint.node_paint import NodeLook, full_width
from smsl_studio.studio.base.theme import Tokens, text_font
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.features.supervise.card import HEIGHT, INSET, CardButton, CardForecast
from smsl_studio.studio.features.supervise.columns import (
    NARROWEST,
    STACKED,
    TALL,
    Columns,
    columns,
    stacked_columns,
)
from smsl_studio.studio.features.supervise.legend import PartialLegend
from smsl_studio.studio.features.supervise.spot import StateSpot, clock
from smsl_studio.studio.features.supervise.wires import (
    LIT,
    draw_dots,
    draw_way,
    draw_way_down,
    draw_wire,
    fan,
)

PITCH = 64
TOP, BOTTOM = 8, 12
APART = 96.0
"""How far the previous state stands above the active one (pixels)."""


class PartialSurface(QWidget):
    """Cards stand in a column.

    The active and the previous state stay in the middle of the visible part.
    """

    card_chosen = Signal(object)
    state_chosen = Signal(str)
    seen_wanted = Signal(object)

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._tokens, self._ink = tokens, Ink(tokens)
        self._blueprint: Blueprint | None = None
        self._picture: Picture | None = None
        self._sensed: tuple[tuple[int, str], ...] = ()
        self._window = QRect()
        self.view: PartialView | None = None
        self.columns: Columns | None = None
        self.cards: list[CardButton] = []
        self._previous, self._current = self._spot(), self._spot()
        self._neighbours: list[StateSpot] = []
        self._stays: list[QLabel] = []
        self._via = Label("", self)
        self._legend = PartialLegend(tokens, self)
        self._centres: dict[str, float] = {}
        self._told: object = None
        self._forecast: CardForecast | None = None
        self._selected: frozenset[str] = frozenset()

    def _spot(self) -> StateSpot:
        made = StateSpot(self._ink, self)
        made.pressed.connect(self.state_chosen)
        return made

    def show_selected(self, states: frozenset[str]) -> None:
        """Ring these of the states to which the operations lead."""
        if states != self._selected:
            self._selected = states
            self._arrange()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens, self._ink = tokens, Ink(tokens)
        for spot in (self._previous, self._current, *self._neighbours):
            spot.set_ink(self._ink)
        for card in self.cards:
            card.set_tokens(tokens)
        self._legend.set_tokens(tokens)
        self._arrange()

    def show_view(
        self,
        blueprint: Blueprint | None,
        view: PartialView | None,
        chosen: Address | None,
        sensed: tuple[tuple[int, str], ...],
    ) -> None:
        """Show a view, unless it is the same; ``sensed`` lists (digit, "differs" or "unknown")."""
        # A run reports many times a second, but only whole seconds are shown.
        whole = replace(view, seconds=float(int(view.seconds))) if view is not None else None
        told = (whole, chosen, sensed)
        if blueprint is self._blueprint and told == self._told:
            return
        self._told = told
        if blueprint is not self._blueprint:
            self._blueprint, self._picture = blueprint, None
        if view is not None and (self._picture is None or self._picture.branch.name != view.branch):
            assert blueprint is not None
            self._picture = Picture(blueprint, view.branch)
        self.view, self._sensed = view, sensed
        self._fill_cards(view.cards if view else (), chosen)
        self._arrange()

    def show_forecast(self, told: CardForecast | None) -> None:
        """Show a forecast on the card of its operation. None takes the words away."""
        self._forecast = told
        for button in self.cards:
            own = told is not None and told.edge == button.card.address
            button.show_forecast(told if own else None)

    def set_window(self, window: QRect) -> None:
        """Set the visible part (pixels), in whose middle the states stay."""
        if window != self._window:
            before, self._window = self._stacks, window
            self._arrange()
            if self._stacks != before:
                self.updateGeometry()

    @property
    def _stacks(self) -> bool:
        """Whether the previous state stands above the active one: the view is narrow and tall."""
        return self._window.width() < NARROWEST and self._window.height() >= TALL

    def shown_spots(self) -> list[StateSpot]:
        """The visible states."""
        spots = (self._previous, self._current, *self._neighbours)
        return [spot for spot in spots if not spot.isHidden()]

    def sizeHint(self) -> QSize:
        """High enough for all cards."""
        count = len(self.view.cards) if self.view else 0
        return QSize(800, TOP + count * PITCH + BOTTOM)

    def minimumSizeHint(self) -> QSize:
        """High enough for all cards, with the smallest width of the columns."""
        return QSize(STACKED if self._stacks else NARROWEST, self.sizeHint().height())

    # Filling.

    def _fill_cards(self, cards: tuple[OperationCard, ...], chosen: Address | None) -> None:
        while len(self.cards) > len(cards):
            gone = self.cards.pop()
            gone.hide()
            gone.deleteLater()
        for at, card in enumerate(cards):
            if at == len(self.cards):
                made = CardButton(card, self._tokens, self)
                made.clicked.connect(lambda _=False, one=made: self._press(one))
                made.step_wanted.connect(lambda step, one=made: self._step(one, step))
                made.show()
                self.cards.append(made)
            button = self.cards[at]
            button.prefix = self._picture.prefix if self._picture is not None else ""
            picked = card.address == chosen
            if button.card != card or button.property("picked") != picked:
                button.setProperty("picked", picked)
                button.show_card(card, picked)
        self.show_forecast(self._forecast)
        self.updateGeometry()

    def _press(self, button: CardButton) -> None:
        self.card_chosen.emit(button.card.address)

    def _step(self, button: CardButton, step: int) -> None:
        at = min(max(self.cards.index(button) + step, 0), len(self.cards) - 1)
        self.cards[at].setFocus(Qt.FocusReason.TabFocusReason)
        self.seen_wanted.emit(self.cards[at])

    # Placing.

    def _arrange(self) -> None:
        view, picture = self.view, self._picture
        for spot in (self._previous, self._current):
            spot.setVisible(view is not None)
        if view is None or picture is None:
            for extra in (*self._neighbours, *self._stays, self._via, self._legend):
                extra.hide()
            self.update()
            return
        faces = {name: picture.face(picture.index[name]) for name in self._named(view)}
        wide = {name: full_width(face, self._ink) for name, face in faces.items()}
        before = wide[view.via.state] if view.via else 108.0
        after = max((wide[name] for name in view.neighbours), default=108.0)
        place = stacked_columns if self._stacks else columns
        self.columns = place(self.width(), (before, wide[view.state], after))
        self._place_cards(view)
        self._place_states(view, faces)
        self._place_neighbours(view, faces)
        self._place_legend(view)
        self.update()

    @staticmethod
    def _named(view: PartialView) -> list[str]:
        names = [view.state, *view.neighbours]
        return [*names, view.via.state] if view.via else names

    def _place_cards(self, view: PartialView) -> None:
        assert self.columns is not None
        x, wide = self.columns.cards
        whole = len(view.cards) * PITCH
        top = max(TOP, (self.height() - whole) // 2)
        rows: dict[str, list[float]] = {}
        for at, button in enumerate(self.cards):
            y = top + at * PITCH + (PITCH - HEIGHT) // 2
            button.setGeometry(
                round(x) - INSET, y - INSET, round(wide) + 2 * INSET, HEIGHT + 2 * INSET
            )
            rows.setdefault(button.card.target, []).append(y + HEIGHT / 2)
        self._centres = {name: sum(ys) / len(ys) for name, ys in rows.items()}

    def _place_states(self, view: PartialView, faces: dict[str, Face]) -> None:
        assert self.columns is not None
        assert self._picture is not None
        branch, middle = self._picture.branch, self._middle()
        x, most = self.columns.current
        look = NodeLook(active=True, facts=self._sensed)
        words = (view.title, f"for {clock(view.seconds)}")
        self._current.show_state(branch, faces[view.state], look, "active", most, words)
        self._current.place(QPointF(x + most / 2, middle))
        self._previous.setVisible(view.via is not None)
        self._via.setVisible(view.via is not None)
        if view.via is None:
            return
        x, most = self.columns.previous
        face = faces[view.via.state]
        look, words = NodeLook(visited=True), ("", face.title)
        self._previous.show_state(branch, face, look, "previous", most, words)
        if self.columns.stacked:
            self._previous.place(QPointF(x + most / 2, middle - APART))
            self._show_via(view, most - 8)
            self._via.move(round(x + (most - self._via.width()) / 2), round(middle - APART / 2 - 9))
            return
        self._previous.place(QPointF(x + most / 2, middle))
        left, right = self._way()
        self._show_via(view, right - left - 12)
        shift = 14 if view.via_mark else 0
        at = (left + right - 8 - self._via.width() - shift) / 2 + shift
        self._via.move(round(at), round(middle - 24))

    def _show_via(self, view: PartialView, room: float) -> None:
        """Show the operation by which the run came, at most so wide (pixels)."""
        assert view.via is not None
        kind = Type(text_font(11, 500))
        shown = kind.elided(view.via.operation, room - (14 if view.via_mark else 0))
        self._via.setFont(kind.font)
        self._via.setText(shown)
        paper = self._tokens.canvas.name() if self._stacks else "transparent"
        self._via.setStyleSheet(f"color: {self._tokens.acc.name()}; background: {paper}")
        self._via.setToolTip(tip_text(str(view.via)))
        self._via.setAccessibleName(plain_text(f"came by {view.via.operation}"))
        self._via.adjustSize()

    def _place_neighbours(self, view: PartialView, faces: dict[str, Face]) -> None:
        assert self.columns is not None
        assert self._picture is not None
        x, most = self.columns.neighbours
        while len(self._neighbours) < len(view.neighbours):
            self._neighbours.append(self._spot())
        for at, spot in enumerate(self._neighbours):
            spot.setVisible(at < len(view.neighbours))
            if at < len(view.neighbours):
                name = view.neighbours[at]
                look = NodeLook(next=name == view.ahead, selected=name in self._selected)
                spot.show_state(self._picture.branch, faces[name], look, "neighbour", most)
                spot.place(QPointF(x + most / 2, self._centres[name]))
        staying = [button for button in self.cards if button.card.stays]
        while len(self._stays) < len(staying):
            self._stays.append(Label("", self))
        for at, label in enumerate(self._stays):
            label.setVisible(at < len(staying))
            if at < len(staying):
                self._place_stay(label, staying[at], view)

    def _place_stay(self, label: QLabel, button: CardButton, view: PartialView) -> None:
        assert self.columns is not None
        left = self.columns.cards[0] + self.columns.cards[1] + 44
        kind, whole = Type(text_font(12)), f"stays in {view.state}"
        label.setFont(kind.font)
        label.setText(kind.elided(whole, self.width() - left - 8))
        label.setToolTip(tip_text(whole if label.text() != whole else ""))
        label.setProperty("role", "small")
        label.adjustSize()
        y = button.y() + button.height() / 2
        label.move(round(left), round(y - label.height() / 2))

    def _place_legend(self, view: PartialView) -> None:
        assert self._picture is not None
        branch = self._picture.branch
        digit = next(iter(branch.subs), None)
        self._legend.show_sub("" if digit is None else branch.fact_name(digit))
        self._legend.resize(self._legend.sizeHint())
        bottom = self._window.y() + self._window.height()
        y = bottom - self._legend.height() - 8
        self._legend.move(self._window.x(), y)
        assert self.columns is not None
        under = self._middle() + 27 + 44
        # It may reach below the wires, but never over a card.
        self._legend.setVisible(y > under and self._legend.width() < self.columns.cards[0])
        self._legend.lower()

    def _middle(self) -> float:
        middle = self._window.y() + self._window.height() // 2
        above = self._stacks and self.view is not None and self.view.via is not None
        return max(middle, self._window.y() + APART + 35) if above else middle

    def _way(self) -> tuple[float, float]:
        """The left and the right end of the line from the previous to the active state (pixels)."""
        assert self.columns is not None
        x, wide = self.columns.previous
        left = x + wide / 2 + self._previous.wide / 2
        x, wide = self.columns.current
        return left + 2, x + wide / 2 - self._current.wide / 2 - 6

    # Painting.

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint background, the line to the active state, and the wires."""
        painter = QPainter(self)
        painter.fillRect(event.rect(), self._tokens.canvas)
        draw_dots(painter, event.rect(), self._tokens)
        if self.view is not None and self.columns is not None:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            self._paint_way(painter)
            self._paint_wires(painter)
        painter.end()

    def _paint_way(self, painter: QPainter) -> None:
        assert self.view is not None
        if self.view.via is None:
            return
        middle = self._middle()
        if self.columns is not None and self.columns.stacked:
            x = self.columns.current[0] + self.columns.current[1] / 2
            draw_way_down(painter, x, middle - APART + 29, middle - 33, self._tokens)
        else:
            left, right = self._way()
            draw_way(painter, QPointF(left, middle), QPointF(right, middle), self._tokens)
        if self.view.via_mark:
            at = self._via.geometry()
            draw_sub_mark(painter, at.left() - 9, at.center().y(), self.view.via_mark,
                          self._tokens.acc, self._tokens.canvas)  # fmt: skip

    def _paint_wires(self, painter: QPainter) -> None:
        assert self.view is not None
        assert self.columns is not None
        x, most = self.columns.current
        right, middle = x + most / 2 + self._current.wide / 2 + 5, self._middle()
        leave = fan(len(self.cards))
        order = sorted(range(len(self.cards)), key=lambda at: self.cards[at].card.standing in LIT)
        arriving = self._arrivals()
        for at in order:
            button, card = self.cards[at], self.cards[at].card
            box = QRectF(button.geometry()).adjusted(INSET, INSET, -INSET, -INSET)
            y = box.center().y()
            start = QPointF(right, middle + leave[at])
            draw_wire(painter, start, QPointF(box.left(), y), card.standing, self._tokens, False)
            if card.stays:
                end = QPointF(box.right() + 38, y)
            else:
                x, wide = self.columns.neighbours
                spot = self._neighbours[self.view.neighbours.index(card.target)]
                end = QPointF(x + wide / 2 - spot.wide / 2, arriving[at])
            draw_wire(painter, QPointF(box.right(), y), end, card.standing, self._tokens, True)

    def _arrivals(self) -> list[float]:
        """The y at which each wire meets its target (pixels).

        Wires to one target keep a distance.
        """
        found = []
        for button in self.cards:
            mates = [one for one in self.cards if one.card.target == button.card.target]
            apart = min(16.0, 36.0 / len(mates))
            shift = (mates.index(button) - (len(mates) - 1) / 2) * apart
            found.append(self._centres[button.card.target] + shift)
        return found

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Arrange cards and states in the new width."""
        super().resizeEvent(event)
        self._arrange()
