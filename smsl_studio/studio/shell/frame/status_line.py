"""The status line: counts and place in Draw mode, the run in the others, and a notice."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import PurePath
from weakref import WeakSet

from PySide6.QtCore import QRect, QSize, Qt
from PySide6.QtGui import QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import (
    QApplication,
    QMenu,
    QPushButton,
    QSizePolicy,
    QStatusBar,
    QStyle,
    QStyleOption,
    QWidget,
)

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.legible import plain_text
from smsl_studio.smsl.document import WORDS
from smsl_studio.studio.base.controls import Label, row, rule
from smsl_studio.studio.base.theme import STATUS_LINE
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import counted

ENDING = "Not a medical device"
LONG = 36
"""A part wider than this has a tooltip with its whole text (pixels)."""
READABLE = 120
"""A part wider than this may be shortened to this width, so that the notice at the end is never cut
off (pixels)."""
GAP = 8
"""Pixels between two parts."""
INSET = 6
"""Pixels beside a message."""
SENTENCES = {3: 100, 5: 1}
"""The stretch of the parts that can have a run's sentence: the fourth after the run, the sixth
during it.

During a run the fourth part is the pace, which gets its room first.
"""


class StatusLine(QStatusBar):
    """In Draw mode: counts at the left, form and place at the right. In other modes: the run.

    The notice "Not a medical device" is always at the end.
    """

    def __init__(self) -> None:
        super().__init__()
        self.setFixedHeight(STATUS_LINE)
        self.setSizeGripEnabled(False)
        self.setAccessibleName("Status")
        self._running = False
        self._start = False
        self._left_out = ""
        self.nothing = _Segment()
        self.nothing.setText("No file open")
        self.addWidget(self.nothing)
        self.counts = [_Segment() for _ in range(4)]
        # Only sentences are shortened. A short text with letters cut off would say nothing.
        self.run = [_Segment(whole=at not in SENTENCES) for at in range(6)]
        for part in self.counts:
            self.addWidget(part)
        for at, part in enumerate(self.run):
            self.addWidget(part, SENTENCES.get(at, 0))
        self.form, self.place = _Segment(), _Segment()
        self.run_right = [_Segment(whole=True) for _ in range(3)]
        self.ending = Label(ENDING)
        self.button = QPushButton("Undo")
        """Answers the message that is shown; visible with such a message alone. It always has
        words, because a screen reader finds it while it is hidden too."""
        self.button.setProperty("role", "link")
        self.button.clicked.connect(self._press)
        self._call: Callable[[], object] = lambda: None
        self.addPermanentWidget(self.button)
        self.button.hide()
        for part in (self.form, self.place, *self.run_right):
            self.addPermanentWidget(part)
        self.addPermanentWidget(self.ending)
        self._tip, self._followed = "", WeakSet[QMenu]()
        self.messageChanged.connect(self._follow_menu)
        self.messageChanged.connect(lambda *_: self.button.hide())
        self.messageChanged.connect(lambda *_: self._show_parts())
        self.messageChanged.connect(lambda *_: self._fit_message())
        self._show_parts()

    def show_blueprint(self, blueprint: Blueprint) -> None:
        """Show the numbers of State Branches, states and operations."""
        words = (
            counted(len(blueprint), "State Branch", "State Branches"),
            counted(blueprint.state_count, "state"),
            counted(blueprint.operation_count, "operation"),
        )
        for part, said in zip(self.counts, words, strict=False):
            part.setText(said)
        self._show_parts()

    def show_findings(self, said: str) -> None:
        """Show the number of findings, or that an inspection is in progress."""
        self.counts[3].setText(said)
        self._show_parts()

    def show_place(self, blueprint: Blueprint, address: Address) -> None:
        """Show the line and column of an element, the form of its file, and the file if it is
        imported."""
        home = blueprint.home(address.branch)
        place = home.place(address.path if address.branch else ())
        where = f"line {place.line}, column {place.column}"
        other = "" if home is blueprint.document else f"{PurePath(home.file).name}, "
        self.place.setText(f"{other}{where}" if other else where.capitalize())
        bom = " with BOM" if home.text.startswith("\ufeff") else ""
        ends = {"\r\n": ", CRLF", "\r": ", CR"}.get(home.newline, "")
        self.form.setText(f"{WORDS[home.form]}, UTF-8{bom}{ends}")
        self._show_parts()

    def show_caret(self, line: int, column: int) -> None:
        """Show the line and column of the caret in the source."""
        self.place.setText(f"Line {line}, column {column}")

    def show_run(self, said: tuple[tuple[str, ...], tuple[str, ...]]) -> None:
        """Show the texts about a run, for the left and the right side."""
        for parts, words in zip((self.run, self.run_right), said, strict=True):
            for at, part in enumerate(parts):
                part.setText(words[at] if at < len(words) else "")
        self._show_parts()

    def show_mode(self, mode: str) -> None:
        """Show the parts of a mode: all but the pages of Draw and the start page are about the
        run."""
        self._start = mode == "start"
        self._running = mode not in ("draw", "merge") and not self._start
        self._show_parts()

    def show_line(self, sentence: str, lasts: int, words: str, call: Callable[[], object]) -> None:
        """Show a message for some milliseconds, with a button if ``words`` are not empty."""
        self.showMessage(sentence, lasts)
        self._call = call
        if words:
            self.button.setText(words)
        self.button.setVisible(bool(sentence and words))
        self._show_parts()

    def _press(self) -> None:
        self.clearMessage()
        self._call()

    @property
    def words(self) -> str:
        """All texts at the left, for tests."""
        shown = [self.nothing] if self._start else self.run if self._running else self.counts
        return " | ".join(part.text() for part in shown if part.text())

    @property
    def shown_message(self) -> str:
        """The message as it is painted: with an ellipsis if it is too long."""
        metrics, right = self.fontMetrics(), Qt.TextElideMode.ElideRight
        return metrics.elidedText(
            plain_text(self.currentMessage()), right, self._message_room().width()
        )

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the message, shortened if it is too long; Qt would cut it without a sign."""
        option, painter = QStyleOption(), QPainter(self)
        option.initFrom(self)
        self.style().drawPrimitive(QStyle.PrimitiveElement.PE_PanelStatusBar, option, painter, self)
        if self.currentMessage():
            painter.setPen(self.palette().windowText().color())
            left = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
            painter.drawText(self._message_room(), left, self.shown_message)
        painter.end()

    def minimumSizeHint(self) -> QSize:
        """No least width, so that the parts do not keep the window wide.

        A narrow line hides some parts.
        """
        return QSize(0, STATUS_LINE)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Fit the message and the parts into the new width."""
        super().resizeEvent(event)
        self._show_parts()
        self._fit_message()

    def _follow_menu(self, message: str) -> None:
        """Clear the tip of a menu's row when the menu closes.

        Qt does not clear it if a row was chosen.
        """
        menu = QApplication.activePopupWidget()
        row_ = menu.activeAction() if isinstance(menu, QMenu) else None
        if not isinstance(menu, QMenu) or row_ is None or row_.statusTip() != message:
            return
        self._tip = message
        if menu not in self._followed:
            self._followed.add(menu)
            menu.aboutToHide.connect(self._drop_tip)

    def _drop_tip(self) -> None:
        if self._tip and self.currentMessage() == self._tip:
            self.clearMessage()
        self._tip = ""

    def _message_room(self) -> QRect:
        """The place of the message: as far as the parts at the right."""
        rights = [self.button, self.form, self.place, *self.run_right, self.ending]
        end = min((part.x() for part in rights if part.isVisible()), default=self.width())
        return QRect(INSET, 0, max(end - 2 * INSET, 0), self.height())

    def _fit_message(self) -> None:
        """Have all of a message in the tooltip, if it is shortened."""
        whole = self.currentMessage()
        cut = bool(whole) and self.shown_message != plain_text(whole)
        self.setToolTip(tip_text(whole if cut else self._left_out))

    def _show_parts(self) -> None:
        """Show the parts of the mode. A hint replaces the left side while it is shown."""
        free = not self.currentMessage()
        drawn = not self._running and not self._start
        wanted = [*self.counts] if free and drawn else []
        if free and self._running:
            wanted += [part for part in self.run if part.text()]
        if drawn:
            wanted += [self.form, self.place]
        if self._running:
            wanted += [part for part in self.run_right if part.text()]
        shown = self._fitting(wanted)
        if free and self._start:
            shown.append(self.nothing)
        # Parts are hidden before others are shown. Together they would have too little width for a
        # moment.
        every = [self.nothing, *self._parts]
        for part in sorted(every, key=lambda one: one in shown):
            part.setVisible(part in shown)
        layout = self.layout()
        if layout is not None:
            # This happens at once. Else the parts would be painted at their old places one more
            # time.
            layout.activate()
        self._fit_message()

    def _fitting(self, wanted: list[_Segment]) -> list[_Segment]:
        """The parts for which there is space.

        Others are hidden, in the order of ``_last``, because a few letters of them would say
        nothing. The tooltip of the line has what is hidden.
        """
        shown = list(wanted)
        room = self.width() - self.ending.sizeHint().width() - 2 * GAP
        if not self.button.isHidden():
            # A message that asks for an answer is read before where the file stands.
            message = self.fontMetrics().horizontalAdvance(plain_text(self.currentMessage()))
            room -= self.button.sizeHint().width() + message + 2 * GAP
        needed = sum(part.least + GAP for part in shown)
        left_out: list[str] = []
        for part in self._last:
            if needed > room and part in shown:
                shown.remove(part)
                needed -= part.least + GAP
                left_out.append(part.text())
        self._left_out = "\n".join(reversed(left_out))
        return shown

    @property
    def _parts(self) -> list[_Segment]:
        return [*self.counts, *self.run, self.form, self.place, *self.run_right]

    @property
    def _last(self) -> list[_Segment]:
        """The parts in the order in which they are left out. The findings, and in a run the
        sentence about it, which is its last part at the left, stay."""
        run, right = self.run, self.run_right
        ended = None if run[4].text() else run[3]
        sentence = run[5] if run[5].text() else ended
        about = (run[4], right[0], run[1], run[3], *right[1:], run[0], run[2], run[5])
        drawn = [self.form, self.place, *self.counts[:3]]
        return [*drawn, *(part for part in about if part is not sentence)]


class _Segment(QWidget):
    """One text, with a line after it."""

    def __init__(self, whole: bool = False) -> None:
        """``whole`` says that the text is never shortened."""
        super().__init__()
        self._label = _Saying(whole)
        layout = row(self._label, rule(vertical=True, length=16), spacing=0)
        self.setLayout(layout)
        self.setSizePolicy(QSizePolicy.Policy.Maximum, QSizePolicy.Policy.Preferred)

    def text(self) -> str:
        """The present text."""
        return self._label.text()

    @property
    def least(self) -> int:
        """The width that it needs to be read, if need be with its end left out (pixels)."""
        return self._label.minimumSizeHint().width() + 1

    def setText(self, text: str) -> None:
        """Set the text; a long text is also the tooltip."""
        self._label.setText(text)
        self._label.setToolTip(tip_text(text if self._label.sizeHint().width() > LONG else ""))


class _Saying(Label):
    """A text that ends in an ellipsis if there is no room; the tooltip has all of it."""

    def __init__(self, whole: bool) -> None:
        super().__init__()
        self._whole = whole

    def minimumSizeHint(self) -> QSize:
        """At most ``READABLE`` wide, because a longer text can be shortened.

        Wider if it must be whole.
        """
        least = self.sizeHint()
        return least if self._whole else least.boundedTo(QSize(READABLE, least.height()))

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the text, with an ellipsis if it is too long."""
        painter = QPainter(self)
        painter.setPen(self.palette().windowText().color())
        room = self.contentsRect()
        right = Qt.TextElideMode.ElideRight
        shown = self.fontMetrics().elidedText(plain_text(self.text()), right, room.width() + 1)
        painter.drawText(room, Qt.AlignmentFlag.AlignVCenter, shown)
        painter.end()
