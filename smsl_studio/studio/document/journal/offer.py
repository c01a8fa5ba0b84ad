"""The dialog that offers to recover journals, each with what it would bring back."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from datetime import datetime
from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QDialog,
    QFrame,
    QHBoxLayout,
    QPushButton,
    QScrollArea,
    QSizePolicy,
    QVBoxLayout,
    QWidget,
)

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Elided, label, row, rule
from smsl_studio.studio.base.screens import room
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.document.journal.leftovers import Left
from smsl_studio.studio.document.journal.restoration import brings

WIDTH, TALLEST, NAME = 620, 520, 320
BESIDES = 130
"""Pixels for the sentence above the rows and the button below them."""
SURE = "Discard for good"
Act = Callable[[Left], bool]


class RecoveryOffer(QDialog):
    """A dialog with a row for each journal.

    An undecided journal is offered again at the next start.

    ``recover`` and ``compare`` are called by the buttons. They return False if that was not
    possible.
    """

    def __init__(self, left: Sequence[Left], recover: Act, compare: Act, parent: QWidget) -> None:
        super().__init__(parent)
        self.setWindowTitle("Recover unsaved work")
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setFixedWidth(min(WIDTH, room(self).width()))
        self._waiting = list(left)
        self.rows = {id(one): _Row(one) for one in left}
        column = QVBoxLayout()
        column.setContentsMargins(20, 4, 20, 4)
        column.setSpacing(0)
        for number, one in enumerate(left):
            shown = self.rows[id(one)]
            if number:
                column.addWidget(rule())
            column.addWidget(shown)
            shown.recover.clicked.connect(lambda _=False, one=one: self._do(recover, one))
            shown.discard.clicked.connect(lambda _=False, one=one: self._discard(one))
            shown.compare.clicked.connect(lambda _=False, one=one: compare(one))
        column.addStretch(1)
        self._build(column, len(left))
        self.finished.connect(self._later)

    def row_of(self, left: Left) -> _Row:
        """The row of a journal."""
        return self.rows[id(left)]

    def _build(self, column: QVBoxLayout, number: int) -> None:
        inner = QWidget()
        inner.setLayout(column)
        area = QScrollArea()
        area.setWidgetResizable(True)
        area.setFrameShape(QFrame.Shape.NoFrame)
        area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        area.setWidget(inner)
        # The text wraps, so the height depends on the width.
        most = min(TALLEST, room(self).height() - BESIDES)
        area.setFixedHeight(min(column.totalHeightForWidth(self.width()) + 4, most))
        said = label(
            f"SMSL Studio ended with unsaved work in {counted(number, 'window')}. "
            "What is recovered opens as unsaved changes; the files stay as they are.",
            "second",
        )
        said.setWordWrap(True)
        said.setContentsMargins(20, 18, 20, 6)
        later = QPushButton("Decide later")
        later.clicked.connect(self.reject)
        foot = QHBoxLayout()
        foot.setContentsMargins(20, 8, 20, 16)
        foot.addStretch(1)
        foot.addWidget(later)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(0, 0, 0, 0)
        whole.addWidget(said)
        whole.addWidget(area, 1)
        whole.addLayout(foot)

    def _do(self, act: Act, left: Left) -> None:
        if left not in self._waiting or not act(left):
            return
        self._waiting.remove(left)
        self.row_of(left).done()
        if not self._waiting:
            self.accept()

    def _discard(self, left: Left) -> None:
        """The first click changes the button to a question, because a discarded journal is lost."""
        if self.row_of(left).is_sure():
            self._do(_drop, left)

    def _later(self) -> None:
        for left in self._waiting:
            left.keep()
        self._waiting.clear()


class _Row(QWidget):
    """One journal: what was kept of one window, and the buttons."""

    def __init__(self, left: Left) -> None:
        super().__init__()
        entry = left.entry
        self.setAccessibleName(plain_text(f"Unsaved work in {entry.name}"))
        self.name = Elided(entry.name)
        self.name.setProperty("role", "heading")
        self.name.setToolTip(tip_text(entry.name))
        self.name.setSizePolicy(QSizePolicy.Policy.Maximum, QSizePolicy.Policy.Preferred)
        self.name.ensurePolished()
        self.name.setMinimumWidth(min(self.name.sizeHint().width(), NAME))
        folder = Elided(str(Path(entry.path).parent) if entry.path else "never saved")
        folder.setProperty("role", "small")
        folder.setToolTip(tip_text(entry.path))
        told = brings(entry)
        self.brings = label(told.words, "second")
        self.brings.setWordWrap(True)
        self.when = label(f"Last change {_day(entry.when)}", "small")
        self.recover = QPushButton("Recover")
        self.recover.setProperty("role", "primary")
        self.compare = QPushButton("Show difference")
        self.discard = QPushButton("Discard")
        self.compare.setEnabled(told.comparable)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 12, 0, 12)
        column.setSpacing(4)
        column.addLayout(row(self.name, folder))
        column.addWidget(self.brings)
        column.addWidget(self.when)
        column.addSpacing(4)
        column.addLayout(row(self.recover, self.compare, self.discard, None))

    def is_sure(self) -> bool:
        """Whether this is the second click on Discard. The first one only changes the button."""
        asked = self.discard.text() == SURE
        self.discard.setText(SURE)
        return asked

    def done(self) -> None:
        """Disable the buttons after a decision."""
        for button in (self.recover, self.compare, self.discard):
            button.setEnabled(False)


def _drop(left: Left) -> bool:
    left.drop()
    return True


def _day(when: str) -> str:
    """A time as people write it; a text that is no time stays as it is."""
    try:
        return f"{datetime.fromisoformat(when):%d %B %Y, %H:%M:%S}".lstrip("0")
    except ValueError:
        return when
