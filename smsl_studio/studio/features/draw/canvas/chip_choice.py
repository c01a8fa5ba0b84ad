"""ChipChoice: the facts of a state that is to be, as chips that keys and clicks change."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QFocusEvent, QKeyEvent, QMouseEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QWidget

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.blueprint.names import fact_choices
from smsl_studio.legible import plain_text
from smsl_studio.picture.chip_kinds import OFF, ON, VALUE
from smsl_studio.studio.base.chips import CHIP, fact_words, paint_chip
from smsl_studio.studio.base.paint.ink import NO_BRUSH
from smsl_studio.studio.base.theme import Tokens, mono_font
from smsl_studio.studio.base.tips import tip_text

Key = Qt.Key
GAP = 6
ROW = CHIP + 8


class ChipChoice(QWidget):
    """One chip for each fact. Left and Right go from chip to chip; Up, Down, Space or a click
    change its value, and so does a character if values have one.

    Signals: ``changed``, ``done`` (Enter), ``left`` (Esc), ``tabbed`` (Tab).
    """

    changed = Signal()
    done = Signal()
    left = Signal()
    tabbed = Signal()

    def __init__(
        self, parent: QWidget, tokens: Tokens, branch: StateBranch, values: tuple[str, ...]
    ) -> None:
        super().__init__(parent)
        self._tokens, self._branch = tokens, branch
        self.values = values
        self._at = len(values) - 1
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMouseTracking(True)
        self._describe()

    def show_values(self, values: tuple[str, ...]) -> None:
        """Show other values."""
        self.values = values
        self._describe()
        self.update()

    def place_of(self, digit: int) -> QRectF:
        """The rectangle of a chip; chips that do not fit go to a further row."""
        return self._places(self.width())[digit]

    def event(self, event: QEvent) -> bool:
        """Keep plain keys from the window's shortcuts, and emit ``tabbed``."""
        if isinstance(event, QKeyEvent):
            plain = not event.modifiers() & Qt.KeyboardModifier.ControlModifier
            if event.type() is QEvent.Type.ShortcutOverride and plain:
                event.accept()
                return True
            tab = event.key() in (Key.Key_Tab, Key.Key_Backtab)
            if event.type() is QEvent.Type.KeyPress and tab:
                self.tabbed.emit()
                return True
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Go from chip to chip, or change the value of one."""
        key, text = event.key(), event.text()
        if key in (Key.Key_Return, Key.Key_Enter):
            self.done.emit()
        elif key == Key.Key_Escape:
            self.left.emit()
        elif key in (Key.Key_Left, Key.Key_Right):
            self._go(1 if key == Key.Key_Right else -1)
        elif key in (Key.Key_Up, Key.Key_Down, Key.Key_Space):
            self._turn(self._at, -1 if key == Key.Key_Down else 1)
        elif text.isalnum() and self._branch.shape.width == 1:
            self._put(self._at, text)
            self._go(1)
        else:
            super().keyPressEvent(event)
            return
        event.accept()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Give the chip below the pointer its next value."""
        digit = self._digit_at(event)
        if digit >= 0:
            self._at = digit
            self._turn(digit, 1)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Tell in the tooltip what the value below the pointer means."""
        digit = self._digit_at(event)
        words = fact_words(self._branch, digit, self.values[digit]) if digit >= 0 else ""
        self.setToolTip(tip_text(words))

    def focusInEvent(self, event: QFocusEvent) -> None:
        """Show which chip the keys change."""
        super().focusInEvent(event)
        self.update()

    def focusOutEvent(self, event: QFocusEvent) -> None:
        """Hide which chip the keys would change."""
        super().focusOutEvent(event)
        self.update()

    def heightForWidth(self, width: int) -> int:
        """The height of all rows of chips."""
        return int(self._places(width)[-1].bottom()) + 6

    def sizeHint(self) -> QSize:
        """As wide as the card gives, and as high as its rows."""
        wide = max(self.width(), 40)
        return QSize(wide, self.heightForWidth(wide))

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the chips; the one that keys change has a ring."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        places = self._places(self.width())
        for digit, (value, place) in enumerate(zip(self.values, places, strict=True)):
            sub = digit in self._branch.subs
            paint_chip(painter, place, value, self._kind(digit), self._tokens, sub=sub)
        if self.hasFocus():
            painter.setPen(QPen(self._tokens.acc, 2))
            painter.setBrush(NO_BRUSH)
            painter.drawRoundedRect(places[self._at].adjusted(-3, -3, 3, 3), 6, 6)
        painter.end()

    def _places(self, width: int) -> list[QRectF]:
        metrics_font = mono_font(12, 500)
        places: list[QRectF] = []
        x, y = 4.0, 4.0
        for value in self.values:
            wide = max(float(CHIP), 8.0 * len(value) * metrics_font.pixelSize() / 12 + 8)
            if places and x + wide > width - 4:
                x, y = 4.0, y + ROW
            places.append(QRectF(x, y, wide, CHIP))
            x += wide + GAP
        return places

    def _kind(self, digit: int) -> str:
        """How to paint a chip: as the canvas paints such a value."""
        if set(fact_choices(self._branch, digit)) != {"0", "1"}:
            return VALUE
        return ON if self.values[digit] == self._branch.on_value(digit) else OFF

    def _digit_at(self, event: QMouseEvent) -> int:
        places = enumerate(self._places(self.width()))
        return next((d for d, place in places if place.contains(event.position())), -1)

    def _go(self, step: int) -> None:
        self._at = (self._at + step) % len(self.values)
        self.update()

    def _turn(self, digit: int, step: int) -> None:
        choices = fact_choices(self._branch, digit)
        value = self.values[digit]
        at = choices.index(value) if value in choices else -1
        self._put(digit, choices[(at + step) % len(choices)])

    def _put(self, digit: int, value: str) -> None:
        self.show_values((*self.values[:digit], value, *self.values[digit + 1 :]))
        self.changed.emit()

    def _describe(self) -> None:
        words = [fact_words(self._branch, d, value) for d, value in enumerate(self.values)]
        self.setAccessibleName(plain_text("Facts of the copy: " + ", ".join(words)))
