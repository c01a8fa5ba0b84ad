"""The card of a bundle: its operations, each with direction, name and who acts.

It opens while the pointer is on the line of the bundle. A click on the line pins it. A click in a
row selects the operation, which then has a line of its own.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from PySide6.QtCore import QEvent, QRect, QRectF, Qt, QTimer
from PySide6.QtGui import QEnterEvent, QKeyEvent
from PySide6.QtWidgets import QFrame, QHBoxLayout, QScrollArea, QVBoxLayout, QWidget

from smsl_studio.legible import plain_text
from smsl_studio.picture.picture import Picture
from smsl_studio.studio.base.canvas.branch_view import BranchView
from smsl_studio.studio.base.canvas.bundle_layer import bundles_among
from smsl_studio.studio.base.controls import Label
from smsl_studio.studio.base.overlays.bundle_row import HIGH, BundleLine, BundleRow
from smsl_studio.studio.base.overlays.card import Card, IconButton, tint
from smsl_studio.studio.base.theme import Tokens, mono_font

LINGER = 450
"""How long the card stays after the pointer has left it and its line (ms)."""
AWAY, RIM, HEAD = 14, 8, 34
"""The distance of the card from the chip, from the border of the view, and the height of its first
line (pixels)."""
FARTHER = (36, 60, 84)
"""The distances from the chip that are tried, too, so that the card covers no state."""
MOST_ROWS = 10
"""A card with more operations scrolls."""


class BundleCard(Card):
    """Shows the operations of one bundle beside its chip."""

    def __init__(self, canvas: BranchView, tokens: Tokens) -> None:
        super().__init__(canvas, tokens, 10.0)
        self._canvas, self.rows = canvas, list[BundleRow]()
        self.pinned = False
        self._own: tuple[int, ...] = ()
        self.float_up()
        self.title = Label("", self)
        self.title.setFont(mono_font(12, 600))
        self.pin = IconButton(self, tokens, "pin", "Keep this open")
        self.pin.clicked.connect(lambda: self.keep(not self.pinned))
        head = QHBoxLayout()
        head.setContentsMargins(12, 2, 4, 0)
        head.addWidget(self.title, 1)
        head.addWidget(self.pin)
        self._scroll = QScrollArea(self)
        self._scroll.setFrameShape(QFrame.Shape.NoFrame)
        self._scroll.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self._scroll.setWidgetResizable(True)
        self._scroll.viewport().setAutoFillBackground(False)
        column = QVBoxLayout(self)
        column.setContentsMargins(1, 1, 1, 7)
        column.setSpacing(2)
        column.addLayout(head)
        column.addWidget(self._scroll)
        self._hide = QTimer(self)
        self._hide.setSingleShot(True)
        self._hide.setInterval(LINGER)
        self._hide.timeout.connect(self.go)
        canvas.pressed.connect(self.go)
        self.hide()

    @property
    def edge(self) -> int:
        """The first edge of the bundle that is shown; -1 while the card is hidden."""
        sheet = self._canvas.sheet
        return sheet.looks.shown_bundle if sheet is not None and not self.isHidden() else -1

    @property
    def leaving(self) -> bool:
        """Whether the card will hide soon, because the pointer is elsewhere."""
        return self._hide.isActive()

    def hover(self, edge: int) -> None:
        """Take the bundle under the pointer (-1 for none): show the card, or hide it soon."""
        if self.pinned or (edge >= 0 and edge == self.edge):
            self._hide.stop()
        elif edge >= 0:
            self._show(edge)
        elif not self.isHidden():
            self._hide.start()

    def open(self, edge: int) -> None:
        """Show the card of a bundle and pin it."""
        if edge != self.edge:
            self.go()
            self._show(edge)
        self.keep(True)

    def step(self, by: int) -> bool:
        """Open the card of the next bundle (``by`` 1) or the previous one (-1).

        The first row gets the keyboard focus. Return False if there are no bundles.
        """
        sheet = self._canvas.sheet
        every = sorted(sheet.picture.bundles.members) if sheet is not None else []
        if not every or sheet is None:
            return False
        first = sheet.picture.bundles.first.get(self.edge, -1)
        at = every.index(first) + by if first in every else (0 if by > 0 else -1)
        edge = every[at % len(every)]
        self._canvas.reveal(sheet.picture.address(edge), smooth=False)
        self.open(edge)
        self.rows[0].setFocus()
        return True

    def keep(self, on: bool) -> None:
        """Pin the card, or let it go with the pointer again."""
        self.pinned, self.pin.accent = on, on
        self._hide.stop()
        self.pin.update()

    def go(self) -> None:
        """Hide at once."""
        self._hide.stop()
        self.keep(False)
        self._mark(-1)
        if not self.isHidden():
            focused = self.isAncestorOf(self.window().focusWidget() or self._canvas)
            self.hide()
            if focused:
                self._canvas.setFocus()

    def follow(self, moved: bool = True) -> None:
        """Keep the card beside its chip after the view has ``moved``, or after other marks are
        drawn.

        The card hides if its chip is out of view, or if its bundle has other operations now. A card
        that is not pinned hides as soon as the view moves.
        """
        sheet, edge = self._canvas.sheet, self.edge
        if edge < 0 or sheet is None:
            return
        if (self.pinned or not moved) and _own(sheet.picture, edge) == self._own:
            place = self._place(edge, self.width(), self.height())
            if self._canvas.rect().contains(place):
                self.setGeometry(place)
                return
        self.go()

    def enterEvent(self, event: QEnterEvent) -> None:
        """Stay while the pointer is on the card."""
        self._hide.stop()

    def leaveEvent(self, event: QEvent) -> None:
        """Hide soon after the pointer has left the card, unless it is pinned."""
        if not self.pinned:
            self._hide.start()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Handle the keys of the card.

        Escape closes the card. L goes to the next bundle, and Shift+L to the previous one. Enter
        selects the operation in the focused row.
        """
        row = next((row for row in self.rows if row.hasFocus()), None)
        if event.key() == Qt.Key.Key_Escape:
            self.go()
        elif event.key() == Qt.Key.Key_L:
            self.step(-1 if event.modifiers() & Qt.KeyboardModifier.ShiftModifier else 1)
        elif event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter) and row is not None:
            row.click()
        else:
            event.ignore()

    def _show(self, edge: int) -> None:
        sheet = self._canvas.sheet
        if sheet is None:
            return
        self._own = _own(sheet.picture, edge)
        title, lines = card_lines(sheet.picture, edge)
        self.title.setText(title)
        self.setAccessibleName(plain_text(f"{len(lines)} operations, {title}"))
        inside = QWidget()
        column = QVBoxLayout(inside)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        self.rows = [BundleRow(inside, self.tokens, line) for line in lines]
        for row in self.rows:
            column.addWidget(row)
            row.clicked.connect(lambda _=False, one=row.line: self._choose(one))
        self._scroll.setWidget(inside)
        inside.setAutoFillBackground(False)
        self.set_tokens(self.tokens)
        wide = max(row.sizeHint().width() for row in self.rows)
        wide = max(wide + 4, self.title.sizeHint().width() + 60)
        high = HEAD + HIGH * min(len(lines), MOST_ROWS) + 14
        self._scroll.setFixedHeight(HIGH * min(len(lines), MOST_ROWS))
        self._mark(edge)
        self.setGeometry(self._place(edge, wide, high))
        self.show()
        self.raise_()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        super().set_tokens(tokens)
        tint(self.title, tokens.tx)
        for row in self.rows:
            row.tokens = tokens
            row.update()

    def _choose(self, line: BundleLine) -> None:
        """Select an operation, as a click on its line does.

        The card closes, because a selected operation is drawn by itself.
        """
        self.go()
        self._canvas.selection_wanted.emit((line.address,))
        if not self._canvas.editing:
            self._canvas.edge_clicked.emit(line.address)
        self._canvas.setFocus()

    def _mark(self, edge: int) -> None:
        """Paint the line of the bundle as chosen while the card is open; -1 for none."""
        sheet = self._canvas.sheet
        if sheet is None or edge == sheet.looks.shown_bundle:
            return
        former, sheet.looks.shown_bundle = sheet.looks.shown_bundle, edge
        count = len(sheet.picture.operations)
        self._canvas.update_edges(one for one in (former, edge) if 0 <= one < count)

    def _place(self, edge: int, wide: int, high: int) -> QRect:
        """A place beside the chip where the card covers no state and not the chip. If there is
        none, one where it covers neither end of the bundle, else the first one inside the view."""
        canvas, sheet = self._canvas, self._canvas.sheet
        assert sheet is not None
        left, top, right, bottom = sheet.geometry.label(edge) or sheet.geometry.fallback(edge)
        chip = canvas.mapFromScene(QRectF(left, top, right - left, bottom - top)).boundingRect()
        room = canvas.rect().adjusted(RIM, RIM, -RIM, -RIM)
        inside = [one for one in _places(chip, wide, high) if room.contains(one)]
        free = (one for one in inside if not self._covers(one))
        ends = self._ends(edge)
        beside = (one for one in inside if not any(map(one.intersects, ends)))
        x = min(max(chip.right() + AWAY, RIM), max(room.right() - wide, RIM))
        y = min(max(chip.top(), RIM), max(room.bottom() - high, RIM))
        near = inside[0] if inside else QRect(x, y, wide, high)
        return next(free, None) or next(beside, near)

    def _ends(self, edge: int) -> list[QRect]:
        """The places of the two states of a bundle in the view; of a lane, those of its first
        operation."""
        canvas, sheet = self._canvas, self._canvas.sheet
        assert sheet is not None
        states = int(sheet.picture.source[edge]), int(sheet.picture.target[edge])
        rects = [canvas.rect_of(sheet.address_of_state(state)) for state in states if state >= 0]
        return [canvas.mapFromScene(rect).boundingRect() for rect in rects if rect is not None]

    def _covers(self, place: QRect) -> bool:
        """Whether a state is below a place in the view."""
        sheet, area = self._canvas.sheet, self._canvas.mapToScene(place).boundingRect()
        assert sheet is not None
        return bool(sheet.states_in(area.left(), area.top(), area.right(), area.bottom()))


def _places(chip: QRect, wide: int, high: int) -> Iterator[QRect]:
    """The places around a chip that are tried, best first."""
    middle = chip.center().x() - wide // 2
    for away in (AWAY, *FARTHER):
        above, below = chip.top() - away - high, chip.bottom() + away
        left, right = chip.left() - away - wide, chip.right() + away
        for x in (middle, chip.left() - 20, chip.right() + 20 - wide):
            yield QRect(x, above, wide, high)
            yield QRect(x, below, wide, high)
        for y in (chip.center().y() - high // 2, chip.top() - 20, chip.bottom() + 20 - high):
            yield QRect(right, y, wide, high)
            yield QRect(left, y, wide, high)


def _own(picture: Picture, edge: int) -> tuple[int, ...]:
    """The operations in the bundle of an edge. Empty if the edge is in no bundle."""
    return picture.bundles.members.get(picture.bundles.first.get(edge, -1), ())


def card_lines(picture: Picture, edge: int) -> tuple[str, list[BundleLine]]:
    """The title of the card of a bundle, and its operations. ``edge`` is one of them."""
    branch, source, target = picture.branch, picture.source, picture.target
    own = picture.bundles.members[picture.bundles.first[edge]]
    start = int(source[own[0]])
    ends = picture.face(start).short, picture.face(int(target[own[0]])).short
    both = any(source[one] != start for one in own)
    lines = [
        BundleLine(
            picture.address(one),
            picture.label(one),
            branch.operation_note(picture.names[source[one]], picture.operations[one]).actor or "",
            int(source[one]) != start,
        )
        for one in own
    ]
    if picture.bundles.first[edge] == picture.bundles.lane:
        starts = (picture.face(int(source[one])).short for one in own)
        back = [
            replace(line, name=f"{line.name} from {start}", back=True)
            for line, start in zip(lines, starts, strict=True)
        ]
        return f"{len(own)} to start {ends[1]}", back
    return f" {'↔' if both else '→'} ".join(ends), lines


def bundle_at(canvas: BranchView, edge: int) -> int:
    """The bundle of an edge under the pointer, by its first edge; -1 for none."""
    sheet = canvas.sheet
    found = bundles_among(sheet, [edge]) if sheet is not None and edge >= 0 else []
    return found[0] if found else -1
