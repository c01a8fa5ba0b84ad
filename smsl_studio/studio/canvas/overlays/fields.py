"""Names edited in place: one field, or those of a new operation; errors are said beside them."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from PySide6.QtCore import QEvent, QObject, QPoint, QRectF, Qt, Signal
from PySide6.QtGui import QFocusEvent, QKeyEvent, QMouseEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QLabel, QLineEdit, QVBoxLayout, QWidget

from smsl_studio.studio.canvas.ink import NO_PEN, Type
from smsl_studio.studio.canvas.overlays.card import Card, tint
from smsl_studio.studio.theme import Tokens, mono_font, text_font

ROWS, ROW = 4, 28


class Field(QLineEdit):
    """A line for a name, in the code font; Enter and Esc are told, Tab goes to the next line."""

    done = Signal()
    left = Signal()
    moved = Signal(int)
    tabbed = Signal()

    def __init__(self, parent: QWidget, tokens: Tokens, hint: str) -> None:
        super().__init__(parent)
        self.setFont(mono_font(12))
        self.setPlaceholderText(hint)
        self.setAccessibleName(hint)
        self.setFrame(False)
        self.setStyleSheet(
            f"QLineEdit {{ background: {tokens.surf.name()}; color: {tokens.tx.name()};"
            f" border: 1px solid {tokens.nl.name()}; border-radius: 6px; padding: 3px 6px; }}"
            f" QLineEdit:focus {{ border: 1px solid {tokens.acc.name()}; }}"
        )
        self.setMinimumHeight(28)

    def event(self, event: QEvent) -> bool:
        if isinstance(event, QKeyEvent) and event.type() is QEvent.Type.ShortcutOverride:
            # Keys belong to the field while it is edited, not to the window's shortcuts.
            if not event.modifiers() & Qt.KeyboardModifier.ControlModifier:
                event.accept()
            return True
        if (
            isinstance(event, QKeyEvent)
            and event.type() is QEvent.Type.KeyPress
            and event.key() in (Qt.Key.Key_Tab, Qt.Key.Key_Backtab)
        ):
            self.tabbed.emit()
            return True
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        key = event.key()
        if key in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self.done.emit()
        elif key == Qt.Key.Key_Escape:
            self.left.emit()
        elif key in (Qt.Key.Key_Up, Qt.Key.Key_Down):
            self.moved.emit(1 if key == Qt.Key.Key_Down else -1)
        else:
            super().keyPressEvent(event)
            return
        event.accept()


class NameField(Card):
    """One name, edited where it stands.

    ``commit`` takes the text and answers with the reason it was refused, or with the empty text.
    Enter commits, Esc leaves everything as it was; leaving by a click elsewhere commits what fits.
    """

    closed = Signal()

    def __init__(
        self,
        parent: QWidget,
        tokens: Tokens,
        text: str,
        hint: str,
        commit: Callable[[str], str],
    ) -> None:
        super().__init__(parent, tokens, 8.0)
        self._commit, self._before, self._closing = commit, text, False
        self.float_up()
        self.field = Field(self, tokens, hint)
        self.field.setText(text)
        self.field.selectAll()
        self.error = _error_label(self, tokens)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(4, 4, 4, 4)
        layout.setSpacing(4)
        layout.addWidget(self.field)
        layout.addWidget(self.error)
        self.field.done.connect(self.commit)
        self.field.left.connect(self.close_field)
        self.field.textEdited.connect(lambda: self._complain(""))
        self.field.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if isinstance(event, QFocusEvent) and event.type() is QEvent.Type.FocusOut:
            reason = event.reason()
            if reason is not Qt.FocusReason.PopupFocusReason and not self._closing:
                self._lost_focus()
        return False

    @property
    def complaint(self) -> str:
        """Why the name was refused; the empty text while nothing is wrong."""
        return self.error.text()

    def commit(self) -> None:
        """Take the name over; a refusal is said, and what was typed stays."""
        if self._closing:
            return
        reason = self._commit(self.field.text().strip())
        if reason:
            self._complain(reason)
            self.field.setFocus()
        else:
            self.close_field()

    def close_field(self) -> None:
        if not self._closing:
            self._closing = True
            self.hide()
            self.closed.emit()
            self.deleteLater()

    def _lost_focus(self) -> None:
        text = self.field.text().strip()
        if not text or text == self._before or self._commit(text):
            # A name that does not fit cannot be taken over unasked, and nobody looks here now.
            self.close_field()
        else:
            self.close_field()

    def _complain(self, reason: str) -> None:
        if reason:
            self.setMinimumWidth(max(self.width(), 230))
        _say(self.error, reason, max(self.width(), 230) - 12)
        self.adjustSize()


class ConnectCard(Card):
    """The fields of a new operation: its name, with the names in use, and perhaps its target.

    ``commit`` takes (operation, target) and answers with a reason or the empty text. Without a
    fixed target the second field names a state that is there, or a new one.
    """

    closed = Signal()

    def __init__(
        self,
        parent: QWidget,
        tokens: Tokens,
        names: Sequence[str],
        operation: str,
        target: str | None,
        commit: Callable[[str, str], str],
        target_for: Callable[[str], str] | None = None,
    ) -> None:
        super().__init__(parent, tokens, 10.0)
        self._names, self._commit, self._closing = list(names), commit, False
        self._target_for, self._own_target = target_for, False
        self.float_up()
        self.operation = Field(self, tokens, "Operation")
        self.operation.setText(operation)
        self.operation.selectAll()
        self.target = Field(self, tokens, "Target state")
        self.target.setText(target or "")
        self.target.setVisible(target is not None)
        self.choices = _Choices(self, tokens)
        self.error = _error_label(self, tokens)
        self._to = QLabel("to state", self)
        self._to.setFont(text_font(11, 500))
        tint(self._to, tokens.tx3)
        self._to.setVisible(target is not None)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(8, 8, 8, 8)
        layout.setSpacing(4)
        for widget in (self.operation, self.choices, self._to, self.target, self.error):
            layout.addWidget(widget)
        self.setFixedWidth(252)
        self._wire()
        self._filter("")

    def _wire(self) -> None:
        for field in (self.operation, self.target):
            field.done.connect(self.commit)
            field.left.connect(self.close_field)
            field.textEdited.connect(lambda: self._complain(""))
        self.operation.textEdited.connect(self._filter)
        self.operation.moved.connect(self.choices.move_choice)
        self.operation.tabbed.connect(self._tab)
        self.target.tabbed.connect(self.operation.setFocus)
        self.target.textEdited.connect(self._target_typed)
        self.choices.chosen.connect(self._choose)

    def commit(self) -> None:
        """Add the operation; a refusal is said, and what was typed stays."""
        if self._closing:
            return
        chosen = self.choices.current
        if chosen and self.operation.hasFocus():
            self._take(chosen)
        reason = self._commit(self.operation.text().strip(), self.target.text().strip())
        if reason:
            self._complain(reason)
        else:
            self.close_field()

    def close_field(self) -> None:
        if not self._closing:
            self._closing = True
            self.hide()
            self.closed.emit()
            self.deleteLater()

    @property
    def complaint(self) -> str:
        return self.error.text()

    def _target_typed(self) -> None:
        self._own_target = True

    def _tab(self) -> None:
        if self.choices.current:
            self._take(self.choices.current)
        if not self.target.isHidden():
            self.target.setFocus()
            self.target.selectAll()

    def _choose(self, name: str) -> None:
        self._take(name)
        self.operation.setFocus()
        self.commit()

    def _take(self, name: str) -> None:
        self.operation.setText(name)
        self._suggest_target(name)
        self.choices.show_names([], "")
        self.adjustSize()

    def _suggest_target(self, name: str) -> None:
        if self._target_for is not None and not self._own_target and not self.target.isHidden():
            wanted = self._target_for(name)
            if wanted:
                self.target.setText(wanted)

    def _filter(self, typed: str) -> None:
        wanted = typed.strip().casefold()
        found = [name for name in self._names if wanted in name.casefold()]
        found.sort(key=lambda name: not name.casefold().startswith(wanted))
        exact = typed.strip() in found
        self.choices.show_names([] if exact else found[:ROWS], typed.strip())
        if exact:
            self._suggest_target(typed.strip())
        self.adjustSize()

    def _complain(self, reason: str) -> None:
        _say(self.error, reason, self.width() - 16)
        self.adjustSize()


class _Choices(QWidget):
    """The names that fit what was typed; none is chosen until an arrow key or click does."""

    chosen = Signal(str)

    def __init__(self, parent: QWidget, tokens: Tokens) -> None:
        super().__init__(parent)
        self._tokens = tokens
        self._type, self._soft = Type(text_font(13)), Type(text_font(12))
        self._names: list[str] = []
        self._at = -1
        self.setCursor(Qt.CursorShape.PointingHandCursor)

    @property
    def current(self) -> str:
        return self._names[self._at] if 0 <= self._at < len(self._names) else ""

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(self._names)

    def show_names(self, names: list[str], typed: str) -> None:
        self._names, self._at = names, -1
        self.setVisible(bool(names))
        self.setFixedHeight(len(names) * ROW)
        self.update()

    def move_choice(self, step: int) -> None:
        if self._names:
            self._at = (self._at + step) % len(self._names)
            self.update()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        row = int(event.position().y() // ROW)
        if 0 <= row < len(self._names):
            self.chosen.emit(self._names[row])

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        for i, name in enumerate(self._names):
            rect = QRectF(0, i * ROW, self.width(), ROW - 1)
            if i == self._at:
                painter.setPen(NO_PEN)
                painter.setBrush(self._tokens.accs)
                painter.drawRoundedRect(rect, 5, 5)
            text = self._type.elided(name, self.width() - 20)
            self._type.draw_from(painter, 8, rect.center().y(), text, self._tokens.tx)
        painter.setPen(QPen(self._tokens.line, 1))
        painter.end()


def _error_label(parent: QWidget, tokens: Tokens) -> QLabel:
    label = QLabel("", parent)
    label.setFont(text_font(12))
    label.setWordWrap(True)
    label.setTextFormat(Qt.TextFormat.PlainText)
    tint(label, tokens.bad)
    label.hide()
    return label


def _say(label: QLabel, reason: str, width: int) -> None:
    label.setText(reason)
    label.setFixedWidth(width)
    label.setFixedHeight(label.heightForWidth(width) if reason else 0)
    label.setAccessibleName(reason)
    label.setVisible(bool(reason))


def place_near(widget: QWidget, area: QWidget, at: QPoint) -> None:
    """Put a widget at a point of an area, wholly inside it."""
    widget.adjustSize()
    x = min(max(at.x(), 8), max(area.width() - widget.width() - 8, 8))
    y = min(max(at.y(), 8), max(area.height() - widget.height() - 8, 8))
    widget.move(x, y)
