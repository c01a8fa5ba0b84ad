"""A message over the canvas: what was refused, or what was done. It is never a dialog."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from PySide6.QtCore import QEvent, QObject, QPoint, QRect, QRectF, Qt, QTimer
from PySide6.QtGui import QMouseEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QLabel, QPushButton, QVBoxLayout, QWidget

from smsl_studio.errors import StudioError
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.announcement import announce
from smsl_studio.studio.base.controls import label
from smsl_studio.studio.base.icons import SEVERITY_ICON, draw, severity_colour
from smsl_studio.studio.base.keys_back import KeysBack
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import brief, capital

REFUSED_MS, SAID_MS, WIDTH = 12_000, 3_000, 460
NARROWER = (300, 210)
"""Widths that are tried if a message finds no place (pixels)."""
TOP = 40
"""Where a message begins that would cover what somebody works on (pixels from the top)."""
READING_MS = 70
"""Milliseconds for each letter, because a long sentence takes longer to read."""


class MessageLine(Protocol):
    """A line for messages that find no free place over the canvas."""

    def show_line(self, sentence: str, lasts: int, words: str, call: Callable[[], object]) -> None:
        """Show a sentence for some milliseconds, with a button that says ``words``; none if these
        are empty. An empty sentence clears the line."""


class Toast(QWidget):
    """A message at the bottom of ``over`` for some seconds; a click hides it.

    ``severity`` is ``E`` for a refusal or a failure, ``W`` for a remark about a step, else empty.
    """

    def __init__(self, tokens: Tokens, over: QWidget) -> None:
        super().__init__(over)
        self._tokens, self.severity, self.over = tokens, "", over
        self._sentence: QLabel = label("", "heading")
        self._advice: QLabel = label("", "small")
        for part in (self._sentence, self._advice):
            part.setWordWrap(True)
            part.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(38, 10, 14, 10)
        layout.setSpacing(2)
        layout.addWidget(self._sentence)
        layout.addWidget(self._advice)
        self._spared = QRect()
        self.seat: Callable[[QRect, QRect], QPoint | None] = lambda wanted, now: wanted.topLeft()
        """Called with the usual place and the present one (empty while hidden): where it covers
        nothing that somebody works on, None if there is no such place."""
        self.line: MessageLine | None = None
        """Shows what has no place here where it can cover nothing."""
        self._folded = ""
        self._call: Callable[[], object] = lambda: None
        self._of_step = self._fresh = False
        self._seated = True
        self.button = QPushButton("Undo")
        self.button.setProperty("role", "row")
        self.button.clicked.connect(self._press)
        self.button.hide()
        layout.addWidget(self.button, 0, Qt.AlignmentFlag.AlignLeft)
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.timeout.connect(self.hide)
        over.installEventFilter(self)
        KeysBack(self)
        self.hide()

    @property
    def words(self) -> str:
        """The text that is shown; empty if there is none."""
        parts = (self._sentence.text(), self._advice.text())
        shown = not self.isHidden() or bool(self._folded)
        return " ".join(part for part in parts if part) if shown else ""

    def hide(self) -> None:
        """Hide the message, also where it is only a line."""
        if self._folded and self.line is not None:
            self._folded = ""
            self.line.show_line("", 0, "", self._press)
        super().hide()

    def settle(self) -> None:
        """Look for another place if what somebody works on came below the message."""
        if not self.isHidden():
            self._place()
            self._fold_if_seatless()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def refuse(self, error: StudioError) -> None:
        """Show what was refused, what to do, and where."""
        place = f" ({error.place})" if error.place else ""
        self._show(capital(error.sentence), f"{error.advice}{place}".strip(), "E", REFUSED_MS)

    def say(self, sentence: str) -> None:
        """Show that something went well."""
        self._show(sentence, "", "", max(SAID_MS, READING_MS * len(brief(sentence))))

    def offer(
        self, sentence: str, words: str, call: Callable[[], object], severity: str = ""
    ) -> None:
        """Show what was done or found, with a button that reacts to it, such as Undo."""
        self._call = call
        self._show(sentence, "", severity, REFUSED_MS, words)
        self._of_step = True

    def bring_back(self, sentence: str, call: Callable[[], object]) -> None:
        """Show that something typed was not taken, with a button that brings it back."""
        self.offer(sentence, "Back to it", call, "W")

    def spare(self, rect: QRect) -> None:
        """Do not cover this part of the screen (global pixels), because somebody works there."""
        self._spared = rect
        self.settle()

    def edited(self) -> None:
        """Hide a message about an earlier step, because the history has moved by a step.

        A message of ``of_step`` is shown while its step is carried out, so it survives the first
        call.
        """
        if self._fresh:
            self._fresh = False
        elif self._of_step:
            self.hide()

    def of_step(
        self, sentence: str, severity: str, undo: Callable[[], object] | None = None
    ) -> None:
        """Show a consequence of the step that is being carried out; the next step hides it. With
        ``undo`` a button undoes the step."""
        if sentence:
            self._call = undo or self._call
            self._show(sentence, "", severity, REFUSED_MS, "Undo" if undo is not None else "")
            self._of_step = self._fresh = True

    def warn(self, sentence: str) -> None:
        """Show that something went wrong, other than a refusal."""
        self._show(sentence, "", "E", REFUSED_MS)

    def fail(self, sentence: str, words: str, call: Callable[[], object]) -> None:
        """Show that the program failed, with a button that tells more."""
        self.tell(sentence, words, call, "E")

    def tell(
        self, sentence: str, words: str, call: Callable[[], object], severity: str = ""
    ) -> None:
        """Show what has happened, with a button that tells more. An edit does not hide it."""
        self._call = call
        self._show(sentence, "", severity, REFUSED_MS, words)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Stay in place when the widget below changes its size."""
        if watched is self.over and event.type() == QEvent.Type.Resize:
            self.settle()
        return super().eventFilter(watched, event)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Hide the message."""
        self.hide()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint background and icon in the colour of the severity."""
        tokens, painter, severity = self._tokens, QPainter(self), self.severity
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(tokens.bad if severity == "E" else tokens.line2, 1))
        painter.setBrush(tokens.surf)
        painter.drawRoundedRect(QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5), 8, 8)
        name = SEVERITY_ICON.get(severity, "check")
        ink = severity_colour(severity, tokens) if severity else tokens.ok
        draw(painter, name, QRectF(13, 12, 15, 15), ink, tokens.surf)

    def _press(self) -> None:
        self.hide()
        self._call()

    def _show(self, sentence: str, advice: str, severity: str, lasts: int, words: str = "") -> None:
        """Show a message. ``words`` are those of its button; it has none if they are empty."""
        self.severity = severity
        self._of_step = self._fresh = False
        # Hidden it keeps its words, because a screen reader finds it, too.
        self.button.setText(words or self.button.text())
        self.button.setVisible(bool(words))
        sentence, advice = brief(sentence), brief(advice)
        self._sentence.setText(sentence)
        self._advice.setText(advice)
        self._advice.setVisible(bool(advice))
        self.setAccessibleName(plain_text(f"{sentence} {advice}".strip()))
        self._folded, self._seated = "", True
        super().hide()
        self._place()
        self.show()
        self.raise_()
        self._timer.start(lasts)
        announce(self, self.accessibleName(), urgent=severity == "E")
        self._fold_if_seatless()

    def _fold_if_seatless(self) -> None:
        """Become a line, with the button, if there is no free place. A refusal stays as it is."""
        if self._seated or self.severity == "E" or self.line is None:
            return
        super().hide()
        self._folded = self.accessibleName()
        words = "" if self.button.isHidden() else self.button.text()
        self.line.show_line(self._folded, max(self._timer.remainingTime(), 1), words, self._press)

    def _place(self) -> None:
        """Take a free place; a message that has none in its usual width is tried narrower."""
        for most in (WIDTH, *NARROWER):
            usual = self._usual_place(most)
            now = QRect() if self.isHidden() else QRect(self.pos(), usual.size())
            at = self.seat(usual, now)
            if at is not None:
                break
        self._seated = at is not None
        usual = usual if at is not None else self._usual_place(WIDTH)
        self.setGeometry(QRect(at if at is not None else usual.topLeft(), usual.size()))

    def _usual_place(self, most: int) -> QRect:
        """The place at the foot of the widget below, at most so wide (pixels)."""
        wide = min(most, self.over.width() - 32)
        natural = self._sentence.fontMetrics().horizontalAdvance(self._sentence.text()) + 70
        other = self._advice.fontMetrics().horizontalAdvance(self._advice.text()) + 70
        wide = max(160, min(wide, max(natural, other)))
        layout = self.layout()
        assert layout is not None
        high = (
            layout.heightForWidth(wide) if layout.hasHeightForWidth() else self.sizeHint().height()
        )
        left = (self.over.width() - wide) // 2
        place = QRect(left, self.over.height() - high - 64, wide, high)
        spared = QRect(self.over.mapFromGlobal(self._spared.topLeft()), self._spared.size())
        if place.intersects(spared):
            above = place.translated(0, TOP - place.top())
            place = above if not above.intersects(spared) else place
        return place
