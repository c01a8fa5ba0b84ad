"""The events of a run in words, the newest last; a click jumps to the element of an event."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QFrame, QListWidget, QListWidgetItem, QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.front.views.event_words import sentence
from smsl_studio.runlog import events as run
from smsl_studio.studio.base.controls import NameDelegate
from smsl_studio.studio.base.theme import mono_font
from smsl_studio.studio.base.tips import tip_text

QUIET = (run.FactChanged, run.Measured)
LONGEST = 5000
"""The most lines in the list; the log has all events."""


class EventList(QListWidget):
    """A line for each event: its simulated time and what happened."""

    jump_wanted = Signal(object)
    """Address: the person clicked a line about this element."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setObjectName("events")
        self.setItemDelegate(NameDelegate(self))
        self.setFont(mono_font(12))
        self.setUniformItemSizes(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setTextElideMode(Qt.TextElideMode.ElideRight)
        self.setAccessibleName("Events")
        self.itemActivated.connect(self._jump)
        self.itemClicked.connect(self._jump)

    def add_events(self, events: tuple[run.Event, ...]) -> None:
        """Append events. The list stays scrolled to its end if it was there."""
        bar = self.verticalScrollBar()
        at_end = bar.value() >= bar.maximum() - 4
        for event in events:
            if isinstance(event, QUIET):
                continue
            item = QListWidgetItem(f"{event.t:6.2f} s  {sentence(event)}")
            item.setData(Qt.ItemDataRole.UserRole, getattr(event, "address", ""))
            item.setToolTip(tip_text(f"{sentence(event)}\n{event.line()}"))
            self.addItem(item)
        while self.count() > LONGEST:
            self.takeItem(0)
        if at_end:
            self.scrollToBottom()

    def _jump(self, item: QListWidgetItem) -> None:
        text = item.data(Qt.ItemDataRole.UserRole)
        if text:
            self.jump_wanted.emit(Address(*Address.split(text)))
