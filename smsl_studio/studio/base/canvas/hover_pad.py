"""The hover pad: four buttons beside the state under the pointer."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from PySide6.QtCore import QEvent, QPointF, QRect, QRectF, QTimer, Signal
from PySide6.QtGui import QEnterEvent
from PySide6.QtWidgets import QBoxLayout

from smsl_studio.blueprint.address import Address
from smsl_studio.picture.levels import Level
from smsl_studio.studio.base.canvas.branch_view import BranchView
from smsl_studio.studio.base.canvas.sheet import Sheet
from smsl_studio.studio.base.overlays.card import Card, IconButton, PassingCard
from smsl_studio.studio.base.theme import Tokens

DELAY, LINGER = 500, 450
AWAY = 20
LONG, SHORT = 114, 30
"""The sides of the pad: four buttons in a column or a row (pixels)."""


class HoverPad(Card):
    """Buttons that add an operation, connect, add a self loop, and rename.

    It appears after the pointer has rested on a state, beside it, where it covers no node and no
    label. Beside most states that is a column; above or below it is a row.
    """

    operation_wanted = Signal(object)
    """Address: the user wants to draw an operation from this state."""

    def __init__(self, canvas: BranchView, tokens: Tokens, busy: Callable[[], bool]) -> None:
        super().__init__(canvas, tokens, 8.0)
        self._canvas, self._busy = canvas, busy
        self.float_up()
        self._address: Address | None = None
        self._next: Address | None = None
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
        self._hide = self._timer(LINGER, self.go)
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
        canvas = self._canvas
        sheet = canvas.sheet
        wanted = (
            address is not None
            and not address.operation
            and canvas.editing
            and not self._busy()
            and sheet is not None
            and sheet.level is Level.FULL
        )
        if wanted and address == self._address and not self.isHidden():
            self._hide.stop()
            return
        self._next = address if wanted else None
        if wanted:
            self._show.start()
        else:
            self._show.stop()
        if not self.isHidden():
            self._hide.start()

    def go(self) -> None:
        """Hide at once."""
        self._show.stop()
        self._hide.stop()
        self._address = None
        self.hide()

    def enterEvent(self, event: QEnterEvent) -> None:
        """Stay while the pointer is on the pad."""
        self._hide.stop()

    def leaveEvent(self, event: QEvent) -> None:
        """Hide soon after the pointer has left the pad."""
        self._hide.start()

    def _appear(self) -> None:
        place = self.place_for(self._next) if self._next is not None else None
        asked = any(not card.isHidden() for card in self._canvas.findChildren(PassingCard))
        if place is None or asked or self._busy():
            return
        self._address = self._next
        self._hide.stop()
        across = place.width() > place.height()
        way = QBoxLayout.Direction
        self._buttons.setDirection(way.LeftToRight if across else way.TopToBottom)
        self.setGeometry(place)
        self.show()
        self.raise_()

    def place_for(self, state: Address) -> QRect | None:
        """A place beside a state where the pad covers no node and no label (pixels).

        None if there is none.
        """
        canvas, sheet, rect = self._canvas, self._canvas.sheet, self._canvas.rect_of(state)
        if sheet is None or rect is None:
            return None
        node = canvas.mapFromScene(rect).boundingRect()
        labels = self._labels(sheet, node)
        for place in _places(node):
            area = canvas.mapToScene(place).boundingRect()
            sides = area.left(), area.top(), area.right(), area.bottom()
            covers = any(area.intersects(label) for label in labels)
            if canvas.rect().contains(place) and not covers and not sheet.states_in(*sides):
                return place
        return None

    def _labels(self, sheet: Sheet, node: QRect) -> list[QRectF]:
        """The labels around the node, as scene rectangles."""
        room = AWAY + LONG
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
    left, right = node.left() - AWAY - SHORT, node.right() + AWAY
    middle, last = node.center().y() - LONG // 2, node.bottom() - LONG
    for y in (middle, last, node.top()):
        yield QRect(left, y, SHORT, LONG)
        yield QRect(right, y, SHORT, LONG)
    above, below = node.top() - AWAY - SHORT, node.bottom() + AWAY
    for x in (node.center().x() - LONG // 2, node.left(), node.right() - LONG):
        yield QRect(x, above, LONG, SHORT)
        yield QRect(x, below, LONG, SHORT)
