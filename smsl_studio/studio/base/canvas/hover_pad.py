"""The hover pad: four buttons beside the state under the pointer."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QEvent, QPoint, QRectF, QSize, QTimer, Signal
from PySide6.QtGui import QEnterEvent
from PySide6.QtWidgets import QVBoxLayout

from smsl_studio.blueprint.address import Address
from smsl_studio.picture.levels import Level
from smsl_studio.studio.base.canvas.branch_view import BranchView
from smsl_studio.studio.base.overlays.card import Card, IconButton
from smsl_studio.studio.base.theme import Tokens

DELAY, LINGER = 500, 450
AWAY = 20


class HoverPad(Card):
    """Buttons that add an operation, connect, add a self loop, and rename.

    It appears after the pointer has rested on a state, beside it, where it covers no node.
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
        layout = QVBoxLayout(self)
        layout.setContentsMargins(1, 3, 1, 3)
        layout.setSpacing(0)
        for button in (self.add, self.connect_to, self.loop, self.rename):
            button.setFixedSize(28, 28)
            layout.addWidget(button)
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

    def sizeHint(self) -> QSize:
        """Room for four buttons in a column."""
        return QSize(30, 118)

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
        if self._next is None or self._busy():
            return
        rect = self._canvas.rect_of(self._next)
        if rect is None:
            return
        place = self._free_place(QRectF(self._canvas.mapFromScene(rect).boundingRect()))
        if place is None:
            return
        self._address = self._next
        self._hide.stop()
        self.resize(self.sizeHint())
        self.move(place)
        self.show()
        self.raise_()

    def _free_place(self, node: QRectF) -> QPoint | None:
        """A place left or right of the node where the pad covers no other node.

        None if there is none.
        """
        canvas, size = self._canvas, self.sizeHint()
        sheet = canvas.sheet
        assert sheet is not None
        top = node.center().y() - size.height() / 2
        places = [
            (node.left() - AWAY - size.width(), top),
            (node.right() + AWAY, top),
            (node.left() - AWAY - size.width(), node.bottom() - size.height()),
            (node.right() + AWAY, node.bottom() - size.height()),
        ]
        for x, y in places:
            corner, far = (
                QPoint(int(x), int(y)),
                QPoint(int(x) + size.width(), int(y) + size.height()),
            )
            if not canvas.rect().contains(corner) or not canvas.rect().contains(far):
                continue
            a, b = canvas.mapToScene(corner), canvas.mapToScene(far)
            if not sheet.states_in(a.x(), a.y(), b.x(), b.y()):
                return corner
        return None

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
