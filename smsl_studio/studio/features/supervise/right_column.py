"""The column at the right of Supervise: questions to people, the reason of a hold, and Step in."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, QTimer, Signal
from PySide6.QtWidgets import QVBoxLayout, QWidget

from smsl_studio.studio.base.controls import rule
from smsl_studio.studio.base.panels import empty_panel
from smsl_studio.studio.base.room import Room
from smsl_studio.studio.features.supervise.step_in import StepIn
from smsl_studio.studio.running.hold_card import HoldCard

MARGIN = 12
WIDE, NARROW = 330, 240
"""The smallest width of the column, and that in a narrow page (pixels)."""


class RightColumn(QWidget):
    """The right column. Task and hold card scroll if they need more space; Step in stays visible
    below.

    In a low page the whole column scrolls, and a new question is scrolled into view. There, *Give
    back* does not scroll. ``task_slot`` is the layout for the task card.
    """

    room_changed = Signal(int)
    """int: the height (pixels) that the task card has above Step in. 0 if the column scrolls."""

    def __init__(self, hold: HoldCard, step_in: StepIn) -> None:
        super().__init__()
        self._step_in, self._low, self._pinned = step_in, False, False
        inner = QWidget()
        self._column = QVBoxLayout(inner)
        self._column.setContentsMargins(12, MARGIN, 12, 0)
        self._column.setSpacing(12)
        self.task_slot = QVBoxLayout()
        self.task_slot.setContentsMargins(0, 0, 0, 0)
        self.task_slot.setSpacing(12)
        self._column.addLayout(self.task_slot)
        self._column.addWidget(hold)
        self._below = QVBoxLayout()
        self._below.setContentsMargins(12, 12, 12, 12)
        self._below.addWidget(step_in)
        panel, whole = empty_panel()
        self._room, self._edge = Room(inner), rule()
        for part in (self._room.viewport(), step_in):
            part.installEventFilter(self)
        self._edge.hide()
        # The line shows that the part above can be scrolled.
        self._room.verticalScrollBar().rangeChanged.connect(lambda *_: self._ranged())
        whole.addWidget(self._room)
        whole.addWidget(self._edge)
        whole.addLayout(self._below)
        whole.addStretch(1)
        around = QVBoxLayout(self)
        around.setContentsMargins(0, 0, 0, 0)
        around.addWidget(panel)
        self.setMinimumWidth(WIDE)
        step_in.turned.connect(lambda _: self._pin())

    def fit(self, narrow: bool, low: bool) -> None:
        """Need less width in a narrow page, and scroll as a whole in a low one."""
        self.setMinimumWidth(NARROW if narrow else WIDE)
        self._step_in.set_narrow(narrow)
        if low == self._low:
            return
        self._low = low
        (self._column if low else self._below).addWidget(self._step_in)
        self._column.setContentsMargins(12, 12, 12, 12 if low else 0)
        self._pin()
        self._room.updateGeometry()
        self._tell_room()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Tell the task card how high it may be."""
        if event.type() == QEvent.Type.Resize:
            self._tell_room()
        return super().eventFilter(watched, event)

    def _tell_room(self) -> None:
        """Step in is as high as it needs to be, so the task card gets what is left."""
        wide = self.width()
        below = self._below.heightForWidth(wide) if self._below.hasHeightForWidth() else 0
        below = max(below, self._below.sizeHint().height())
        self.room_changed.emit(0 if self._low else max(self.height() - below - MARGIN - 1, 1))

    def _pin(self) -> None:
        """Put *Give back* below the scrolled part while the person has control, so that it is
        visible.
        """
        pinned = self._low and self._step_in.taken
        if pinned != self._pinned:
            self._pinned = pinned
            self._step_in.put_hand(self._below if pinned else None)
        edge = 8 if pinned else 0 if self._low else 12
        self._below.setContentsMargins(12, edge, 12, edge)
        self._show_edge()

    def see_question(self) -> None:
        """Scroll so far that the open question is seen, as soon as it has its size."""
        QTimer.singleShot(0, self, self._see)

    def _ranged(self) -> None:
        self._show_edge()
        self._see()

    def _show_edge(self) -> None:
        """Show the line below the scrolled part, if something is below it."""
        scrolls = self._room.verticalScrollBar().maximum() > 0
        self._edge.setVisible(scrolls and (self._pinned or not self._low))

    def _see(self) -> None:
        asking = self._step_in.asking
        if self._low and asking.isVisible():
            self._room.ensureWidgetVisible(asking, 0, 8)
