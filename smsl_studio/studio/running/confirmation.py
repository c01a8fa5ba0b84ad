"""The box that asks for confirmation of a decision: Enter does it, Escape cancels."""

from __future__ import annotations

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QKeyEvent, QResizeEvent
from PySide6.QtWidgets import (
    QAbstractButton,
    QApplication,
    QBoxLayout,
    QFrame,
    QLabel,
    QLineEdit,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import label, row
from smsl_studio.studio.base.in_view import scroll_to
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import as_it_is, capital
from smsl_studio.studio.running.decisions import Decision

SIDE, GAP = 12, 6
AROUND = 28
"""Pixels that a button needs beside its words."""


class ConfirmBox(QFrame):
    """The confirmation of one decision; hidden while there is none.

    Enter and Escape act while the box has the keyboard focus. A page that hears them everywhere
    says so by ``anywhere``; else the box names them only while it has the focus.
    """

    confirmed = Signal(object, str)
    """(Decision, reason): the person confirmed it."""
    dropped = Signal()

    def __init__(self, anywhere: bool = False) -> None:
        super().__init__()
        self._anywhere = anywhere
        self.setObjectName("asking")
        self.setAccessibleName("Decision")
        self.decision: Decision | None = None
        self._sentence, self._detail = label("", "strong"), label("", "hint")
        self._sentence.setWordWrap(True)
        self.reason = QLineEdit()
        self.reason.setPlaceholderText("Why, for the record")
        self.reason.setAccessibleName("Reason")
        self.reason.textEdited.connect(lambda _: self.refuse(""))
        self._refusal = label("", "refusal")
        self.do = QPushButton("Do it")
        self.do.setProperty("role", "primary")
        self.do.clicked.connect(self.confirm)
        self.leave = QPushButton("Do nothing")
        self.leave.clicked.connect(self.drop)
        self._keys = (_key("Enter"), _key("Esc"))
        column = QVBoxLayout(self)
        column.setContentsMargins(SIDE, 10, SIDE, 12)
        column.setSpacing(6)
        for part in (self._sentence, self._detail, self.reason, self._refusal):
            column.addWidget(part)
        # The buttons stand below each other if they do not fit side by side.
        self._buttons = QBoxLayout(QBoxLayout.Direction.LeftToRight)
        self._buttons.setSpacing(GAP)
        for button, key in ((self.do, self._keys[0]), (self.leave, self._keys[1])):
            pair = row(button, key, spacing=GAP)
            self._buttons.addLayout(pair)
            self._buttons.setAlignment(pair, Qt.AlignmentFlag.AlignLeft)
        self._buttons.addStretch(1)
        self.do.setMinimumWidth(1)
        column.addSpacing(2)
        column.addLayout(self._buttons)
        self.hide()
        application = QApplication.instance()
        assert isinstance(application, QApplication)
        application.focusChanged.connect(self._focus_moved)

    @property
    def words(self) -> str:
        """All shown texts in one line, for tests and assistive tools."""
        parts = (self._sentence, self._detail, self._refusal)
        return " ".join(part.text() for part in parts if not part.isHidden() and part.text())

    def show_decision(self, decision: Decision | None) -> None:
        """Ask for this decision; None hides the box."""
        if decision == self.decision:
            return
        anew = decision is None or self.decision is None or (
            decision.command, decision.address
        ) != (self.decision.command, self.decision.address)  # fmt: skip
        self.decision = decision
        self.setVisible(decision is not None)
        if decision is None:
            return
        _say(self._sentence, decision.sentence)
        _say(self._detail, decision.detail)
        self.reason.setVisible(decision.reasoned)
        self.do.setVisible(bool(decision.verb))
        self._show_keys()
        self.leave.setText("Do nothing" if decision.verb else "Close")
        self._fit()
        if anew:
            self.refuse("")
            self.reason.clear()

    def _focus_moved(self, _: QWidget | None, now: QWidget | None) -> None:
        self._show_keys()

    def _show_keys(self) -> None:
        """Name the keys where they act. Another button that has the focus takes Enter for
        itself."""
        focus = QApplication.focusWidget()
        inside = focus is not None and self.isAncestorOf(focus)
        act = self._anywhere or inside
        enters = inside or (act and not isinstance(focus, QAbstractButton))
        verb = self.decision is not None and bool(self.decision.verb)
        for key, there in zip(self._keys, (enters and verb, act), strict=True):
            key.setVisible(there)

    def _fit(self) -> None:
        """Put the buttons side by side, or below each other if they do not fit.

        The words of the first button are shortened in the middle if they are still too long.
        """
        verb = plain_text(self.decision.verb) if self.decision is not None else ""
        self.do.ensurePolished()
        metrics, (enter, escape) = self.do.fontMetrics(), self._keys
        room = self.contentsRect().width() - 2 * SIDE
        first = room - GAP - enter.sizeHint().width()
        second = self.leave.sizeHint().width() + GAP + escape.sizeHint().width()
        beside = metrics.horizontalAdvance(verb) + AROUND <= first - GAP - second
        way = QBoxLayout.Direction
        self._buttons.setDirection(way.LeftToRight if beside else way.TopToBottom)
        words = metrics.elidedText(verb, Qt.TextElideMode.ElideMiddle, first - AROUND)
        self.do.setText(as_it_is(words))
        # A screen reader finds it where it is hidden, too.
        self.do.setAccessibleName(verb or "Do it")
        self.do.setToolTip(tip_text("" if words == verb else verb))

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Fit the buttons into the new width."""
        super().resizeEvent(event)
        self._fit()

    def take_focus(self) -> None:
        """Take the keyboard focus: the reason if one is needed, else the button that does it."""
        decision = self.decision
        if decision is not None:
            part = self.reason if decision.reasoned else self.do if decision.verb else self.leave
            part.setFocus()
            # Not before the box has its size, because it may stand where one has to scroll.
            QTimer.singleShot(0, self, self._come_into_view)

    def _come_into_view(self) -> None:
        """Scroll to the box, and where it is too large to the part that has the keys."""
        scroll_to(self)
        for part in (self.reason, self.do, self.leave):
            if part.hasFocus():
                scroll_to(part)

    def refuse(self, why: str) -> None:
        """Show why it was not done; the decision stays open. Empty hides the sentence."""
        _say(self._refusal, capital(why))

    def confirm(self) -> None:
        """Emit ``confirmed``, if the decision can be done and has the reason it needs."""
        decision = self.decision
        if decision is None or not decision.verb:
            return
        reason = self.reason.text().strip()
        if decision.reasoned and not reason:
            self.refuse("A reason is needed: it stands in the record")
            self.reason.setFocus()
            return
        self.confirmed.emit(decision, reason)

    def drop(self) -> None:
        """Close the box and emit ``dropped``."""
        self.show_decision(None)
        self.dropped.emit()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Enter confirms, or cancels if that button has the focus; Escape cancels."""
        enter = event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter)
        if event.key() == Qt.Key.Key_Escape or (enter and self.leave.hasFocus()):
            self.drop()
        elif enter:
            self.confirm()
        else:
            super().keyPressEvent(event)


def _say(part: QLabel, words: str) -> None:
    part.setText(words)
    part.setVisible(bool(words))


def _key(words: str) -> QLabel:
    made = label(words, "key")
    made.setAlignment(Qt.AlignmentFlag.AlignCenter)
    return made
