"""The hover pad: four buttons beside the state under the pointer, else beside the selected one."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from PySide6.QtCore import QEvent, QPoint, QPointF, QRect, QRectF, QTimer, Signal
from PySide6.QtGui import QEnterEvent
from PySide6.QtWidgets import QBoxLayout

from smsl_studio.blueprint.address import Address
from smsl_studio.picture.levels import Level
from smsl_studio.studio.base.canvas.branch_view import BranchView
from smsl_studio.studio.base.canvas.sheet import Sheet
from smsl_studio.studio.base.overlays.card import Card, IconButton, PassingCard
from smsl_studio.studio.base.theme import Tokens

DELAY, LINGER = 500, 450
AWAY = (20, 36, 52)
"""How far the pad stands from the node; farther where it would cover something (pixels)."""
CLEAR = 18
"""How far it stays away from other nodes, so that their handles and the ends of their lines are
free, and from the handles of the selected operation (pixels)."""
GAP = 3
"""The room between it and a line (pixels)."""
UNDER = 10
"""It does not appear so near to the pointer (pixels)."""
LONG, SHORT = 114, 30
"""The sides of the pad: four buttons in a column or a row (pixels)."""


class HoverPad(Card):
    """Buttons that add an operation, connect, add a self loop, and rename.

    It appears after the pointer has rested on a state, or when one state is selected, and comes
    back after a press or a movement of the view. It stands where it covers no node, no handle and
    no end of a line at a node, and no label and no line either if there is such a place. It never
    appears below the pointer, which may be about to press what is there. Beside most states it is a
    column; above or below them it is a row.
    """

    operation_wanted = Signal(object)
    """Address: the user wants to draw an operation from this state."""

    def __init__(self, canvas: BranchView, tokens: Tokens, busy: Callable[[], bool]) -> None:
        super().__init__(canvas, tokens, 8.0)
        self._canvas, self._busy = canvas, busy
        self.float_up()
        self._address: Address | None = None
        self._hovered: Address | None = None
        self._chosen: Address | None = None
        self._pointer: QPoint | None = None
        self.add = IconButton(self, tokens, "plus", "Add an operation to a new state (Tab)")
        self.add.accent = True
        self.connect_to = IconButton(self, tokens, "arrow", "Connect with another state")
        self.loop = IconButton(self, tokens, "loop", "Add an operation that leads back here")
        self.rename = IconButton(self, tokens, "pencil", "Rename (F2)")
        self._buttons = QBoxLayout(QBoxLayout.Direction.TopToBottom, self)
        self._buttons.setContentsMargins(1, 1, 1, 1)
        self._buttons.setSpacing(0)
        for button in (self.add, self.connect_to, self.loop, self.rename):
            button.setFixedSize(28, 28)
            self._buttons.addWidget(button)
        self._show = self._timer(DELAY, self._appear)
        self._hide = self._timer(LINGER, self._leave)
        self._wire()
        self.hide()

    def _timer(self, delay: int, call: object) -> QTimer:
        timer = QTimer(self)
        timer.setSingleShot(True)
        timer.setInterval(delay)
        timer.timeout.connect(call)
        return timer

    def _wire(self) -> None:
        self.add.clicked.connect(self._add)
        self.connect_to.clicked.connect(self._connect)
        self.loop.clicked.connect(self._loop)
        self.rename.clicked.connect(self._rename)

    @property
    def address(self) -> Address | None:
        """The state that the pad belongs to; None while it is hidden."""
        return self._address if not self.isHidden() else None

    def hover(self, address: Address | None) -> None:
        """Take the element under the pointer (None for none): show or hide the pad after a
        delay."""
        self._hovered = address if address is not None and not address.operation else None
        self._follow()

    def choose(self, selection: tuple[Address, ...]) -> None:
        """Take what is selected: one state has the pad while the pointer is on no other one."""
        one = selection[0] if len(selection) == 1 else None
        chosen = one if one is not None and one.state and not one.operation else None
        if chosen != self._chosen:
            self._chosen = chosen
            self._follow()

    def point(self, at: QPoint | None) -> None:
        """Take where the pointer is (pixels of the view); None where it has left the canvas.

        There may be a place now, if it was in the way.
        """
        self._pointer = at
        if self.isHidden() and not self._show.isActive():
            self._begin()

    def go(self) -> None:
        """Hide at once. It comes back when what moves is at rest."""
        self._hide.stop()
        self._address = None
        self.hide()
        self._begin()

    @property
    def _wanted(self) -> Address | None:
        """The state that should have the pad; None for none."""
        canvas, sheet = self._canvas, self._canvas.sheet
        shown = canvas.editing and sheet is not None and sheet.level is Level.FULL
        return (self._hovered or self._chosen) if shown else None

    def _follow(self) -> None:
        """Go to the state that should have the pad, after a delay."""
        wanted = self._wanted
        if wanted is not None and wanted == self._address and not self.isHidden():
            self._show.stop()
            self._hide.stop()
            return
        self._begin()
        if not self.isHidden():
            self._hide.start()

    def _begin(self) -> None:
        """Show the pad a moment later, if a state is hovered or selected."""
        if self._wanted is not None:
            self._show.start()
        else:
            self._show.stop()

    def _leave(self) -> None:
        """Leave the state of which the pointer is gone."""
        if self._wanted != self._address:
            self.go()

    def enterEvent(self, event: QEnterEvent) -> None:
        """Stay while the pointer is on the pad."""
        self._hide.stop()
        self._show.stop()

    def leaveEvent(self, event: QEvent) -> None:
        """Hide soon after the pointer has left the pad."""
        self._hide.start()
        self._begin()

    def _appear(self) -> None:
        wanted = self._wanted
        if wanted is None:
            return
        asked = any(not card.isHidden() for card in self._canvas.findChildren(PassingCard))
        # A sketch shows what a drag from the library, or a card, would draw.
        if asked or self._busy() or self._canvas.gestures.sketch is not None:
            self._show.start()
            return
        place = self.place_for(wanted)
        if place is None:
            return
        self._address = wanted
        self._hide.stop()
        across = place.width() > place.height()
        way = QBoxLayout.Direction
        self._buttons.setDirection(way.LeftToRight if across else way.TopToBottom)
        self.setGeometry(place)
        self.show()
        self.raise_()

    def place_for(self, state: Address) -> QRect | None:
        """A place beside a state where the pad covers no node, no handle and no end of a line at a
        node (pixels), and if there is one, where it covers no label and no line either.

        None if there is none.
        """
        canvas, sheet, rect = self._canvas, self._canvas.sheet, self._canvas.rect_of(state)
        if sheet is None or rect is None:
            return None
        node = canvas.mapFromScene(rect).boundingRect()
        labels, second, third = self._labels(sheet, node), None, None
        taken = self._taken(sheet, sheet.picture.node(state))
        for place in _places(node):
            if not canvas.rect().contains(place) or any(map(place.intersects, taken)):
                continue
            area = canvas.mapToScene(place).boundingRect()
            if canvas.is_covered(place) or sheet.drawn.touches(*_sides(area)):
                continue
            if any(area.intersects(label) for label in labels):
                third = third or place
            elif sheet.is_drawn_on(*_sides(canvas.mapToScene(_around(place, GAP)).boundingRect())):
                second = second or place
            else:
                return place
        return second or third

    def _taken(self, sheet: Sheet, own: int) -> list[QRect]:
        """Where the pad of a state may not stand: on other cards, nodes and handles, and below the
        pointer (pixels of the view)."""
        canvas = self._canvas
        cards = [one for one in canvas.findChildren(Card) if one is not self]
        taken = [one.geometry() for one in cards if not one.isHidden()]
        seen = canvas.mapToScene(canvas.rect()).boundingRect()
        near = sheet.states_in(seen.left(), seen.top(), seen.right(), seen.bottom())
        for state in near:
            node = canvas.rect_of(sheet.address_of_state(state))
            if node is not None:
                out = CLEAR if state != own else AWAY[0] - 1
                taken.append(_around(canvas.mapFromScene(node).boundingRect(), out))
        signs = canvas.gestures
        ends = [signs.grip, signs.tail, *(signs.line.bends if signs.line else ())]
        points = [canvas.mapFromScene(end) for end in ends if end is not None]
        taken += [_around(QRect(at, at), CLEAR) for at in points]
        if self._pointer is not None:
            taken.append(_around(QRect(self._pointer, self._pointer), UNDER))
        return taken

    def _labels(self, sheet: Sheet, node: QRect) -> list[QRectF]:
        """The labels around the node, as scene rectangles."""
        room = AWAY[-1] + LONG
        near = self._canvas.mapToScene(node.adjusted(-room, -room, room, room)).boundingRect()
        edges = sheet.edges_in(near.left(), near.top(), near.right(), near.bottom()).tolist()
        found = [label for edge in edges if (label := sheet.geometry.label(edge)) is not None]
        found += [label.rect for label in self._canvas.lit_layer.shown().values()]
        return [QRectF(QPointF(x, y), QPointF(x_end, y_end)) for x, y, x_end, y_end in found]

    def _add(self) -> None:
        if self._address is not None:
            self._canvas.selection_wanted.emit((self._address,))
            self.go()
            self._canvas.quick_add_wanted.emit()

    def _connect(self) -> None:
        if self._address is not None:
            address = self._address
            self.go()
            self.operation_wanted.emit(address)

    def _loop(self) -> None:
        address = self._address
        rect = self._canvas.rect_of(address) if address is not None else None
        if address is not None and rect is not None:
            self.go()
            self._canvas.connect_wanted.emit(address, address, rect.bottomRight())

    def _rename(self) -> None:
        if self._address is not None:
            address = self._address
            self.go()
            self._canvas.rename_wanted.emit(address)


def _places(node: QRect) -> Iterator[QRect]:
    """The places around a node that are tried, best first."""
    middle, last = node.center().y() - LONG // 2, node.bottom() - LONG
    # Lines meet most nodes in the middle of a side, so places at the corners are often free.
    upright = middle, last, node.top(), node.bottom() + 1, node.top() - LONG - 1
    centre = node.center().x()
    corners = centre + 2 * GAP, centre - LONG - 2 * GAP
    across = centre - LONG // 2, node.left(), node.right() - LONG, *corners
    for away in AWAY:
        left, right = node.left() - away - SHORT, node.right() + away
        above, below = node.top() - away - SHORT, node.bottom() + away
        for y in upright:
            yield QRect(left, y, SHORT, LONG)
            yield QRect(right, y, SHORT, LONG)
        for x in across:
            yield QRect(x, above, LONG, SHORT)
            yield QRect(x, below, LONG, SHORT)


def _sides(area: QRectF) -> tuple[float, float, float, float]:
    return area.left(), area.top(), area.right(), area.bottom()


def _around(area: QRect, out: int) -> QRect:
    return area.adjusted(-out, -out, out, out)
