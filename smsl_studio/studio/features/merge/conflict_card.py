"""The card of one conflict: what it is about, and three buttons with the values."""

from __future__ import annotations

from PySide6.QtCore import QRectF, QSize, Qt, Signal
from PySide6.QtGui import QMouseEvent, QPainter, QPaintEvent
from PySide6.QtWidgets import QFrame, QVBoxLayout, QWidget

from smsl_studio.blueprint.comparison.values import said
from smsl_studio.blueprint.merge import ABSENT, Conflict, Side
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Elided, row
from smsl_studio.studio.base.paint.change_signs import CHOSEN, draw_conflict
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.merge.open_merge import WORDS
from smsl_studio.studio.features.merge.side_button import SideButton

SIDES: tuple[Side, ...] = ("ours", "theirs", "base")


class ConflictCard(QFrame):
    """One conflict. A click on the card selects it."""

    taken = Signal(str)
    """str: the version that was clicked."""
    previewed = Signal(str)
    """str: the version under the pointer or with the focus; empty for none."""
    selected = Signal()

    def __init__(self, conflict: Conflict, number: int, tokens: Tokens) -> None:
        super().__init__()
        self.conflict, self.number = conflict, number
        self._tokens, self._current = tokens, False
        self._disc = _Disc(tokens)
        what, where = heading_of(conflict)
        self._what = Elided(what)
        self._what.setProperty("role", "strong")
        self._where = Elided(where)
        self._where.setProperty("role", "small")
        self._where.setAlignment(Qt.AlignmentFlag.AlignRight)
        self.buttons = {side: SideButton(side, WORDS[side], tokens) for side in SIDES}
        for side, button in self.buttons.items():
            button.clicked.connect(lambda _=False, side=side: self.taken.emit(side))
            button.looked_at.connect(lambda on, side=side: self.previewed.emit(side if on else ""))
        column = QVBoxLayout(self)
        column.setContentsMargins(14, 8, 12, 10)
        column.setSpacing(6)
        head = row(self._disc, self._what, self._where)
        head.setStretch(1, 3)
        head.setStretch(2, 2)
        column.addLayout(head)
        column.addLayout(row(*self.buttons.values(), spacing=6))
        self.setAccessibleName(plain_text(f"Conflict {number}: {what}, {where}"))

    def show_choice(self, is_open: bool, side: Side | None) -> None:
        """Show which version was chosen; an open conflict has its number."""
        self._disc.show_number(str(self.number) if is_open else CHOSEN)
        for one, button in self.buttons.items():
            known = one != "base" or self.conflict.base_known
            value = value_words(self.conflict, one) if known else "not known"
            button.show_value(value, one == side and not is_open, known)

    def show_current(self, current: bool) -> None:
        """Mark the card as the one that canvas and source show."""
        if current != self._current:
            self._current = current
            self.update()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self._disc.set_tokens(tokens)
        for button in self.buttons.values():
            button.set_tokens(tokens)
        self.update()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Select the conflict."""
        super().mousePressEvent(event)
        self.selected.emit()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the ground, a line below, and an accent strip on the current card."""
        painter, tokens = QPainter(self), self._tokens
        painter.fillRect(self.rect(), tokens.sunk if self._current else tokens.surf)
        painter.fillRect(0, self.height() - 1, self.width(), 1, tokens.line)
        if self._current:
            painter.fillRect(0, 0, 3, self.height(), tokens.acc)
        painter.end()


class _Disc(QWidget):
    """The number of a conflict, or a tick."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._tokens, self._number = tokens, ""
        self.setFixedSize(QSize(26, 20))

    def show_number(self, number: str) -> None:
        """Set the number, or the tick."""
        self._number = number
        self.update()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the disc."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        middle = QRectF(self.rect()).center()
        draw_conflict(painter, middle.x(), middle.y(), self._number, self._tokens)
        painter.end()


def value_words(conflict: Conflict, side: Side) -> str:
    """The value of a version in words."""
    value = getattr(conflict, side)
    if value is ABSENT:
        return "not there" if conflict.base is ABSENT else "removed"
    if isinstance(value, dict) and len(conflict.path) <= 2:
        number = sum(1 for key in value if not key.startswith("_"))
        kind = "state" if len(conflict.path) == 1 else "operation"
        return f"kept, {number:,} {kind}{'' if number == 1 else 's'}"
    return str(said(value))


def heading_of(conflict: Conflict) -> tuple[str, str]:
    """What a conflict is about, and where it stands."""
    path = conflict.path
    *above, name = conflict.address.split("/")
    if conflict.about_name:
        return f"Name of {name}", "/".join(above)
    field = path[-1]
    if len(path) <= 2:
        return name, "/".join(above)
    if len(path) == 3 and not path[1].startswith("_") and path[1] != "HEADER":
        return f"{name}, target", above[-1] if above else ""
    if path[-1] == name:
        return name, "/".join(above)
    return f"{name}, {field}", above[-1] if above else ""
