"""The lines below a task card that say how tasks ended. Each stays until it is dismissed."""

from __future__ import annotations

from PySide6.QtCore import QRectF, Signal
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QHBoxLayout, QVBoxLayout, QWidget

from smsl_studio.front.views.task_outcomes import TaskOutcome
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import label
from smsl_studio.studio.base.icons import draw
from smsl_studio.studio.base.small_button import SmallButton
from smsl_studio.studio.base.theme import RADIUS_CONTROL, Tokens

SIGNS = {"answered": "check", "disagreed": "warning", "timed_out": "clock", "withdrawn": "minus"}


class OutcomeLine(QWidget):
    """An icon, the outcome, and a button that removes the line."""

    def __init__(self, line: TaskOutcome, tokens: Tokens) -> None:
        super().__init__()
        self.line, self._tokens = line, tokens
        words = label("\n".join([line.words, *line.late]), "small")
        words.setWordWrap(True)
        self.close_button = SmallButton("Dismiss", "close", tokens)
        across = QHBoxLayout(self)
        across.setContentsMargins(34, 6, 4, 6)
        across.setSpacing(4)
        across.addWidget(words, 1)
        across.addWidget(self.close_button)
        self.setAccessibleName(plain_text(words.text()))

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint background and icon in the colours of the outcome."""
        tokens = self._tokens
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        ink, fill = self._inks()
        painter.setPen(QPen(ink, 1))
        painter.setBrush(fill)
        box = QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5)
        painter.drawRoundedRect(box, RADIUS_CONTROL, RADIUS_CONTROL)
        sign = SIGNS.get(self.line.kind, "note")
        draw(painter, sign, QRectF(11, 11, 14, 14), ink, tokens.surf)
        painter.end()

    def _inks(self) -> tuple[QColor, QColor]:
        tokens = self._tokens
        return {
            "answered": (tokens.ok, tokens.oks),
            "disagreed": (tokens.risk, tokens.risks),
            "timed_out": (tokens.risk, tokens.risks),
        }.get(self.line.kind, (tokens.nl, tokens.sunk))


class OutcomeLines(QWidget):
    """All lines, the newest last; hidden without lines."""

    dismissed = Signal(object)
    """TaskOutcome: the person dismissed it."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._tokens = tokens
        self._lines: tuple[TaskOutcome, ...] = ()
        self.rows: list[OutcomeLine] = []
        self._column = QVBoxLayout(self)
        self._column.setContentsMargins(0, 0, 0, 0)
        self._column.setSpacing(6)
        self.hide()

    @property
    def words(self) -> tuple[str, ...]:
        """The shown outcomes, one text for each line."""
        return tuple(row.accessibleName() for row in self.rows)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self._rebuild()

    def show_lines(self, lines: tuple[TaskOutcome, ...]) -> None:
        """Show these lines, unless they are the same."""
        if lines != self._lines:
            self._lines = lines
            self._rebuild()

    def _rebuild(self) -> None:
        for row in self.rows:
            self._column.removeWidget(row)
            row.hide()
            row.deleteLater()
        self.rows = [OutcomeLine(line, self._tokens) for line in self._lines]
        for row in self.rows:
            self._column.addWidget(row)
            row.close_button.clicked.connect(
                lambda _=False, line=row.line: self.dismissed.emit(line)
            )
        self.setVisible(bool(self.rows))
