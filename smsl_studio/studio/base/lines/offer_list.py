"""Offers below a field for the place of its caret, and the mark of a fault in its text."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QPointF, QStringListModel, Qt
from PySide6.QtGui import QColor, QKeyEvent, QPainter, QPen, QPolygonF
from PySide6.QtWidgets import QCompleter, QLineEdit

from smsl_studio.blueprint.properties.completion import Offers
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import NameDelegate

TAKES = (Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Escape)
WIDE = 280
WAVE = 10
"""The least width of the mark of a fault (pixels)."""


class OfferList(QCompleter):
    """The list of offers. ``offers_at`` gets the text and the caret, and returns what fits there.

    The field asks ``takes`` about each key before it types it.
    """

    def __init__(self, field: QLineEdit, offers_at: Callable[[str, int], Offers]) -> None:
        self._texts = QStringListModel(field)
        super().__init__(self._texts, field)
        self._field, self._offers_at = field, offers_at
        self._offers = Offers(0, ())
        self.setCompletionMode(QCompleter.CompletionMode.UnfilteredPopupCompletion)
        self.setMaxVisibleItems(8)
        self.setWidget(field)
        popup = self.popup()
        assert popup is not None
        popup.setItemDelegate(NameDelegate(popup))
        popup.setAccessibleName("What may be typed here")
        self.activated.connect(self._take)
        field.textEdited.connect(lambda _: self._offer())

    def takes(self, event: QKeyEvent) -> bool:
        """Whether a key belongs to the list: Ctrl+Space opens it; while it is shown Enter takes an
        offer, and Escape closes it."""
        popup = self.popup()
        shown = popup is not None and popup.isVisible()
        control = event.modifiers() == Qt.KeyboardModifier.ControlModifier
        if control and event.key() == Qt.Key.Key_Space:
            self._offer()
        elif popup is not None and shown and event.key() in TAKES:
            index = popup.currentIndex()
            popup.hide()
            if event.key() == Qt.Key.Key_Escape:
                return True
            if not index.isValid():
                return False
            self._take(str(index.data()))
        else:
            return False
        return True

    def _offer(self) -> None:
        field, popup = self._field, self.popup()
        if popup is None:
            return
        self._offers = self._offers_at(field.text(), field.cursorPosition())
        if not self._offers.texts:
            popup.hide()
            return
        self._texts.setStringList(list(self._offers.texts))
        self.setCompletionPrefix("")
        rect = field.cursorRect()
        rect.setWidth(WIDE)
        rect.moveLeft(max(0, min(rect.left(), field.width() - WIDE)))
        self.complete(rect)
        # A text that something follows must be one of the offers, any other may be new.
        popup.setCurrentIndex(self._texts.index(0 if self._offers.more else -1))

    def _take(self, chosen: str) -> None:
        field = self._field
        text, caret = field.text(), field.cursorPosition()
        start = self._offers.start
        opens = chosen.endswith("(")
        space = "" if text[caret:].startswith(" ") or opens or not self._offers.more else " "
        field.setText(f"{text[:start]}{chosen}{space}{text[caret:]}")
        field.setCursorPosition(start + len(chosen) + bool(self._offers.more and not opens))
        field.setAccessibleDescription(plain_text(chosen))
        field.textEdited.emit(field.text())


def paint_fault(field: QLineEdit, at: int, ink: QColor) -> None:
    """Paint a wave below the word at an offset of a field's text, in its paint event."""
    metrics, text = field.fontMetrics(), field.text()
    caret = field.cursorRect().center().x()
    zero = caret - metrics.horizontalAdvance(text[: field.cursorPosition()])
    left = zero + metrics.horizontalAdvance(text[:at])
    word = text[at:].split(" ", 1)[0]
    right = left + max(metrics.horizontalAdvance(word), WAVE)
    bottom = field.height() / 2 + metrics.height() / 2 + 1
    room = field.rect().adjusted(6, 0, -6, 0)
    points, first = QPolygonF(), max(left, room.left())
    for number, x in enumerate(range(first, min(right, room.right()) + 1, 3)):
        points.append(QPointF(x, bottom + 2 * (number % 2)))
    painter = QPainter(field)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.setPen(QPen(ink, 1.3))
    painter.drawPolyline(points)
