"""The bar above the canvas that finds in the drawing. It shows; ``DrawingSearch`` searches."""

from __future__ import annotations

from itertools import pairwise

from PySide6.QtCore import QEvent, QObject, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QKeyEvent, QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import QHBoxLayout, QLineEdit, QToolButton, QVBoxLayout, QWidget

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Combo, Label, label, row
from smsl_studio.studio.base.icons import icon
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.features.draw.find.hits import Occurrence

HEIGHT, CONTROL_HEIGHT = 40, 28
FIELD, NARROW_FIELD = 250, 90
WIDE = 640
"""A bar narrower than this (pixels) has its words in a second row."""
SCOPES = ("States and operations", "Facts and notes too", "Everything")
SCOPE_TIPS = (
    "Names, titles and fact values of states and operations",
    "Also facts with the meanings of their values, notes, and titles of groups",
    "Also State Branches, hazards, findings and the operations of plugins",
)
NOTHING = "Nothing is typed yet"
OURS = (Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Up, Qt.Key.Key_Down, Qt.Key.Key_Escape)


class FoundWords(QWidget):
    """Where a hit was found: words, then the text with the found part marked."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._tokens = tokens
        self._before, self._text, self._part = "", "", (0, 0)
        self._brief = ""
        self.setMinimumWidth(40)
        self.setAccessibleName(NOTHING)

    @property
    def words(self) -> str:
        """All of the text."""
        return f"{self._before} “{self._text}”" if self._text else self._before

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def show_words(self, words: str, brief: str = "") -> None:
        """Show a sentence; ``brief`` is for a place that is too narrow for it."""
        self._brief = brief
        self._show(words, "", (0, 0))

    def show_hit(self, hit: Occurrence) -> None:
        """Show in which field a hit is, and mark the part of its text."""
        kind = "" if hit.kind in ("State", "Operation") else f"{hit.kind.lower()}, "
        same = hit.field == hit.kind.lower()
        where = hit.field if same or not kind else f"{kind}{hit.field}"
        self._brief = ""
        self._show(f"Found in {where}", hit.text, (hit.start, hit.end))

    def _show(self, before: str, text: str, part: tuple[int, int]) -> None:
        self._before, self._text, self._part = before, text, part
        self.setToolTip(tip_text(self.words))
        self.setAccessibleName(plain_text(self.words or NOTHING))
        self.update()

    def sizeHint(self) -> QSize:
        """As wide as the words, and one line high."""
        return QSize(self.fontMetrics().horizontalAdvance(self.words) + 16, CONTROL_HEIGHT)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the words; a long text loses what is far from the found part."""
        painter, tokens = QPainter(self), self._tokens
        metrics, right = self.fontMetrics(), Qt.TextElideMode.ElideRight
        whole = plain_text(self._before)
        if self._brief and metrics.horizontalAdvance(whole) > self.width():
            whole = self._brief
        before = metrics.elidedText(whole, right, self.width())
        y = (self.height() + metrics.ascent() - metrics.descent()) // 2
        painter.setPen(tokens.tx2)
        painter.drawText(0, y, before)
        x = metrics.horizontalAdvance(before) + 6
        if not self._text or x > self.width() - 24:
            return
        start, end = self._part
        head, part = plain_text(self._text[:start]), plain_text(self._text[start:end])
        room = self.width() - x - metrics.horizontalAdvance("“”") - 4
        part = metrics.elidedText(part, right, max(room, 0))
        room -= metrics.horizontalAdvance(part)
        left = Qt.TextElideMode.ElideLeft
        head = metrics.elidedText(head, left, max(room, 0))
        room -= metrics.horizontalAdvance(head)
        tail = metrics.elidedText(plain_text(self._text[end:]), right, max(room, 0))
        for piece, marked in ((f"“{head}", False), (part, True), (f"{tail}”", False)):
            wide = metrics.horizontalAdvance(piece)
            if marked:
                painter.setPen(Qt.PenStyle.NoPen)
                painter.setBrush(tokens.accl if tokens.dark else tokens.accs)
                painter.drawRoundedRect(QRectF(x, (self.height() - 18) / 2, wide, 18), 3, 3)
            painter.setPen(tokens.acc if marked and not tokens.dark else tokens.tx)
            painter.drawText(x, y, piece)
            x += wide


class DrawingFindBar(QWidget):
    """A field with the number of the hit, steps, the scope, and where the hit was found."""

    typed = Signal()
    """Text or scope changed."""
    step_wanted = Signal(int)
    """1: go to the next hit; -1: to the one before."""
    closed = Signal()
    """Escape, or the button with the cross."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self.setObjectName("find_bar")
        self.setProperty("role", "bar")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setAccessibleName("Find in the drawing")
        self.field = QLineEdit()
        self.field.setAccessibleName("Find in the drawing")
        self.field.setFixedHeight(CONTROL_HEIGHT)
        self._glass = self.field.addAction(
            icon("search", tokens), QLineEdit.ActionPosition.LeadingPosition
        )
        self._glass.setText("Find")
        self.count: Label = label("", "small")
        self.count.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        inside = row(None, self.count)
        inside.setContentsMargins(0, 0, 10, 0)
        self.field.setLayout(inside)
        self.back = self._button("chevron-up", "Previous hit (Shift+Enter)")
        self.on = self._button("chevron-down", "Next hit (Enter)")
        self.shut = self._button("close", "Close (Esc)")
        self.scope = Combo(height=CONTROL_HEIGHT)
        for at, (words, tip) in enumerate(zip(SCOPES, SCOPE_TIPS, strict=True)):
            self.scope.addItem(words)
            self.scope.setItemData(at, tip, Qt.ItemDataRole.ToolTipRole)
        self.scope.setAccessibleName("Where to find")
        self.scope.setToolTip("Where to find")
        self.scope.setMinimumWidth(self.scope.width_of_entries(100, 190))
        self.found = FoundWords(tokens)
        self._first, self._second = QWidget(), QWidget()
        self._lines = row(self.field, self.back, self.on, spacing=6), row(spacing=8)
        self._build()
        self.set_tokens(tokens)
        self.hide()

    def _build(self) -> None:
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        for widget, line in zip((self._first, self._second), self._lines, strict=True):
            line.setContentsMargins(12, 0, 8, 0)
            widget.setLayout(line)
            widget.setFixedHeight(HEIGHT)
            column.addWidget(widget)
        self._arrange(self._lines[0])
        self._second.hide()
        self.field.textChanged.connect(lambda _: self.typed.emit())
        self.scope.currentIndexChanged.connect(lambda _: self.typed.emit())
        self.back.clicked.connect(lambda: self.step_wanted.emit(-1))
        self.on.clicked.connect(lambda: self.step_wanted.emit(1))
        self.shut.clicked.connect(self.closed)
        self.field.installEventFilter(self)
        stops = (self.field, self.back, self.on, self.scope, self.shut)
        for before, after in pairwise(stops):
            self.setTabOrder(before, after)

    def _arrange(self, line: QHBoxLayout) -> None:
        """Put scope and words into a row; the cross stays at the end of the first."""
        for part in (self.scope, self.found, self.shut):
            for each in self._lines:
                each.removeWidget(part)
        line.addWidget(self.scope)
        line.addWidget(self.found, 1)
        self._lines[0].addWidget(self.shut)
        wide = line is self._lines[0]
        self._lines[0].setStretch(0, 0 if wide else 1)
        self.field.setMinimumWidth(NARROW_FIELD if not wide else FIELD)
        self.field.setMaximumWidth(FIELD if wide else 16_777_215)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Use a second row if one is too narrow."""
        super().resizeEvent(event)
        narrow = self.width() < WIDE
        if narrow == self._second.isHidden():
            self._arrange(self._lines[narrow])
            self._second.setVisible(narrow)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._glass.setIcon(icon("search", tokens))
        for button in (self.back, self.on, self.shut):
            button.setIcon(icon(button.property("picture"), tokens))
        self.found.set_tokens(tokens)

    def open_bar(self, example: str) -> None:
        """Show the bar and mark its text. ``example`` is a filter that fits the drawing."""
        hint = f"Find, or {example}" if example else "Find in the drawing"
        self.field.setPlaceholderText(plain_text(hint))
        self.show()
        self.field.setFocus(Qt.FocusReason.ShortcutFocusReason)
        self.field.selectAll()

    def show_count(self, words: str, steps: bool) -> None:
        """Show the number of the hit, and whether one can step."""
        self.count.setText(words)
        # The typed text ends where the number begins.
        self.field.setTextMargins(0, 0, self.count.sizeHint().width() + 8 if words else 0, 0)
        self.back.setEnabled(steps)
        self.on.setEnabled(steps)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Close on Escape, whatever of the bar has the focus."""
        if event.key() == Qt.Key.Key_Escape:
            self.closed.emit()
        else:
            super().keyPressEvent(event)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Handle Enter, the arrows, Escape and Ctrl+F in the field."""
        if watched is self.field and isinstance(event, QKeyEvent):
            again = (event.key(), event.modifiers()) == (
                Qt.Key.Key_F, Qt.KeyboardModifier.ControlModifier
            )  # fmt: skip
            if event.key() in OURS or again:
                if event.type() == QEvent.Type.ShortcutOverride:
                    event.accept()
                    return True
                if event.type() == QEvent.Type.KeyPress:
                    self._answer(event)
                    return True
        return super().eventFilter(watched, event)

    def _answer(self, event: QKeyEvent) -> None:
        back = bool(event.modifiers() & Qt.KeyboardModifier.ShiftModifier)
        if event.key() == Qt.Key.Key_Escape:
            self.closed.emit()
        elif event.key() == Qt.Key.Key_F:
            self.field.selectAll()
        else:
            self.step_wanted.emit(-1 if back or event.key() == Qt.Key.Key_Up else 1)

    def _button(self, picture: str, name: str) -> QToolButton:
        made = QToolButton()
        made.setProperty("role", "small")
        made.setProperty("picture", picture)
        made.setFixedSize(28, CONTROL_HEIGHT)
        made.setToolTip(tip_text(name))
        made.setAccessibleName(plain_text(name.partition(" (")[0]))
        return made
