"""The status line: what there is, how it is written, where one is, and what this is not."""

from __future__ import annotations

from pathlib import PurePath

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QStatusBar, QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.legible import plain_text
from smsl_studio.smsl.document import WORDS
from smsl_studio.studio.base.controls import Label, row, rule
from smsl_studio.studio.base.theme import STATUS_LINE
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import counted

ENDING = "Not a medical device"
LONG = 64
"""Pixels from which on a saying may be shortened, so that what ends the line is never cut."""
SENTENCES = {3: 100, 5: 1}
"""Where a run, one that is over and one that goes on, has its sentence: it takes what is left.
While a run goes on its pace stands in the first of these, and has its room before the sentence."""


class StatusLine(QStatusBar):
    """Draw: counts at the left, form and place at the right. Run: how it goes, and what it stands
    on. The standing notice ends both."""

    def __init__(self) -> None:
        super().__init__()
        self.setFixedHeight(STATUS_LINE)
        self.setSizeGripEnabled(False)
        self.setAccessibleName("Status")
        self._running = False
        self.counts = [_Segment() for _ in range(4)]
        self.run = [_Segment() for _ in range(6)]
        for part in self.counts:
            self.addWidget(part)
        for at, part in enumerate(self.run):
            self.addWidget(part, SENTENCES.get(at, 0))
        self.form, self.place = _Segment(), _Segment()
        self.run_right = [_Segment() for _ in range(3)]
        self.ending = Label(ENDING)
        for part in (self.form, self.place, *self.run_right):
            self.addPermanentWidget(part)
        self.addPermanentWidget(self.ending)
        self.messageChanged.connect(lambda *_: self._show_parts())
        self._show_parts()

    def show_blueprint(self, blueprint: Blueprint) -> None:
        """How much there is."""
        words = (
            counted(len(blueprint), "State Branch", "State Branches"),
            counted(blueprint.state_count, "state"),
            counted(blueprint.operation_count, "operation"),
        )
        for part, said in zip(self.counts, words, strict=False):
            part.setText(said)

    def show_findings(self, said: str) -> None:
        """What the findings come to, or that they are being looked for."""
        self.counts[3].setText(said)

    def show_place(self, blueprint: Blueprint, address: Address) -> None:
        """Where an element is written, and how; another file than the blueprint's own is named."""
        home = blueprint.home(address.branch)
        place = home.place(address.path if address.branch else ())
        where = f"line {place.line}, column {place.column}"
        other = "" if home is blueprint.document else f"{PurePath(home.file).name}, "
        self.place.setText(f"{other}{where}" if other else where.capitalize())
        bom = " with BOM" if home.text.startswith("\ufeff") else ""
        ends = {"\r\n": ", CRLF", "\r": ", CR"}.get(home.newline, "")
        self.form.setText(f"{WORDS[home.form]}, UTF-8{bom}{ends}")

    def show_caret(self, line: int, column: int) -> None:
        """Where the caret stands in the source."""
        self.place.setText(f"Line {line}, column {column}")

    def show_run(self, said: tuple[tuple[str, ...], tuple[str, ...]]) -> None:
        """How the run stands: sentences for the left and for the right."""
        for parts, words in zip((self.run, self.run_right), said, strict=True):
            for at, part in enumerate(parts):
                part.setText(words[at] if at < len(words) else "")
        self._show_parts()

    def show_mode(self, mode: str) -> None:
        """All modes but Draw speak of the run."""
        self._running = mode != "draw"
        self._show_parts()

    @property
    def words(self) -> str:
        """Everything that is said at the left."""
        shown = self.run if self._running else self.counts
        return " | ".join(part.text() for part in shown if part.text())

    def _show_parts(self) -> None:
        """The parts of the mode. A hint takes the left side while it is there."""
        free = not self.currentMessage()
        for part in self.counts:
            part.setVisible(free and not self._running)
        for part in (self.form, self.place):
            part.setVisible(not self._running)
        for part in self.run:
            part.setVisible(free and self._running and bool(part.text()))
        for part in self.run_right:
            part.setVisible(self._running and bool(part.text()))


class _Segment(QWidget):
    """One saying, with a line after it."""

    def __init__(self) -> None:
        super().__init__()
        self._label = _Saying()
        layout = row(self._label, rule(vertical=True, length=16), spacing=0)
        self.setLayout(layout)
        self.setSizePolicy(QSizePolicy.Policy.Maximum, QSizePolicy.Policy.Preferred)

    def text(self) -> str:
        """What it says now."""
        return self._label.text()

    def setText(self, text: str) -> None:
        """Say something else; a long text is a tip too."""
        self._label.setText(text)
        self._label.setToolTip(tip_text(text if self._label.sizeHint().width() > LONG else ""))


class _Saying(Label):
    """Ends in an ellipsis where there is no room; the tooltip has it all."""

    def minimumSizeHint(self) -> QSize:
        """Never wider than ``LONG``: the text is shortened."""
        return super().minimumSizeHint().boundedTo(QSize(LONG, 1 << 20))

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the text, with an ellipsis where it is too long."""
        painter = QPainter(self)
        painter.setPen(self.palette().windowText().color())
        room = self.contentsRect()
        right = Qt.TextElideMode.ElideRight
        shown = self.fontMetrics().elidedText(plain_text(self.text()), right, room.width() + 1)
        painter.drawText(room, Qt.AlignmentFlag.AlignVCenter, shown)
        painter.end()
