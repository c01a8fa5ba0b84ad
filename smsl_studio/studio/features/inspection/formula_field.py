"""The field for a condition: completion, and a mark at the place of a fault."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QStringListModel, Qt
from PySide6.QtGui import QKeyEvent, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QCompleter, QLineEdit, QWidget

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.properties.completion import Offers, offers_at
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import NameDelegate
from smsl_studio.studio.base.theme import Tokens, mono_font

TAKES = (Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Escape)
WAVE = 10
"""The least width of the mark of a fault (pixels)."""


class FormulaField(QLineEdit):
    """A line for a condition. Ctrl+Space opens the offers, Enter takes one."""

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._tokens = tokens
        self._blueprint: Blueprint | None = None
        self._offers = Offers(0, ())
        self._fault = -1
        self.formulas = True
        """Whether the text is a condition. Otherwise it has no offers."""
        self.setFont(mono_font(12, 400))
        self._model = QStringListModel(self)
        self.offers = QCompleter(self._model, self)
        self.offers.setCompletionMode(QCompleter.CompletionMode.UnfilteredPopupCompletion)
        self.offers.setMaxVisibleItems(8)
        self.offers.setWidget(self)
        popup = self.offers.popup()
        assert popup is not None
        popup.setItemDelegate(NameDelegate(popup))
        popup.setAccessibleName("What may be typed here")
        self.offers.activated.connect(self._take)
        self.textEdited.connect(lambda _: self._offer())

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def set_blueprint(self, blueprint: Blueprint) -> None:
        """Offer the names of this blueprint."""
        self._blueprint = blueprint

    def mark(self, at: int) -> None:
        """Mark the text from an offset on as wrong; -1 marks nothing."""
        if at != self._fault:
            self._fault = at
            self.update()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Ctrl+Space shows the offers. While they are shown Enter and Escape are theirs."""
        popup = self.offers.popup()
        shown = popup is not None and popup.isVisible()
        control = event.modifiers() == Qt.KeyboardModifier.ControlModifier
        if control and event.key() == Qt.Key.Key_Space:
            self._offer()
        elif popup is not None and shown and event.key() in TAKES:
            index = popup.currentIndex()
            popup.hide()
            if index.isValid() and event.key() != Qt.Key.Key_Escape:
                self._take(str(index.data()))
        else:
            super().keyPressEvent(event)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint a wave below the text at the place of the fault."""
        super().paintEvent(event)
        if self._fault < 0:
            return
        metrics, text = self.fontMetrics(), self.text()
        caret = self.cursorRect().center().x()
        zero = caret - metrics.horizontalAdvance(text[: self.cursorPosition()])
        left = zero + metrics.horizontalAdvance(text[: self._fault])
        word = text[self._fault :].split(" ", 1)[0]
        right = left + max(metrics.horizontalAdvance(word), WAVE)
        bottom = self.height() / 2 + metrics.height() / 2 + 1
        room = self.rect().adjusted(6, 0, -6, 0)
        points, first = QPolygonF(), max(left, room.left())
        for at, x in enumerate(range(first, min(right, room.right()) + 1, 3)):
            points.append(QPointF(x, bottom + 2 * (at % 2)))
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(self._tokens.bad, 1.3))
        painter.drawPolyline(points)

    def _offer(self) -> None:
        popup = self.offers.popup()
        if self._blueprint is None or popup is None or not self.formulas:
            return
        self._offers = offers_at(self.text(), self.cursorPosition(), self._blueprint)
        if not self._offers.texts:
            popup.hide()
            return
        self._model.setStringList(list(self._offers.texts))
        self.offers.setCompletionPrefix("")
        rect = self.cursorRect()
        rect.setWidth(280)
        rect.moveLeft(max(0, min(rect.left(), self.width() - 280)))
        self.offers.complete(rect)
        popup.setCurrentIndex(self._model.index(0))

    def _take(self, chosen: str) -> None:
        text, caret = self.text(), self.cursorPosition()
        start = self._offers.start
        space = "" if text[caret:].startswith(" ") or chosen == "(" else " "
        self.setText(f"{text[:start]}{chosen}{space}{text[caret:]}")
        self.setCursorPosition(start + len(chosen) + 1 - (chosen == "("))
        self.setAccessibleDescription(plain_text(chosen))
        self.textEdited.emit(self.text())
