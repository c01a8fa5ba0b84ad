"""The events of a run in words, newest last; a click jumps to what it is about."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QFrame, QListWidget, QListWidgetItem, QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.picture.account_words import told
from smsl_studio.runlog import events as run
from smsl_studio.studio.base.controls import NameDelegate
from smsl_studio.studio.base.theme import mono_font
from smsl_studio.studio.base.tips import tip_text

QUIET = (run.FactChanged,)
LONGEST = 5000
"""Lines kept in the list; the log keeps them all."""


class EventList(QListWidget):
    """One line an event: its time and what happened."""

    jump_wanted = Signal(object)
    """The address a clicked line is about."""

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
        """Append; the list stays at its end if it stood there."""
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


def sentence(event: run.Event) -> str:
    """What happened, in one line."""
    match event:
        case run.RunStarted():
            start = ", ".join(f"{b} in {s}" for b, s in event.start.items())
            return f"Started in the {event.world} world, seed {event.seed}: {start}"
        case run.RoutePlanned():
            return f"Route to {event.goal}: {len(event.operations)} operations, cost {event.cost:g}"
        case run.OperationStarted():
            return f"{event.address} to {event.target} started"
        case run.OperationEnded():
            return f"{event.address} {event.outcome.replace('_', ' ')} {event.message}".rstrip()
        case run.StateChecked():
            why = "; ".join((*event.misses, *event.unknown))
            return f"{event.address} checks {event.result}{': ' + why if why else ''}"
        case run.Committed():
            now = ", ".join(f"{b} in {s}" for b, s in event.configuration.items())
            return f"{', '.join(event.operations)} committed: {now}"
        case run.OperationRefused():
            return f"{event.address} refused: {'; '.join(event.reasons)}"
        case run.OperationRisky():
            return f"{event.address} is risky now: {event.reason}"
        case run.Mismatch():
            return f"Facts and flags differ: {', '.join(event.facts)}"
        case run.Held():
            return f"Held: {event.reason}"
        case run.GoalReached():
            return f"Goal {event.goal} reached"
        case run.RunFinished():
            return f"Finished, {event.reason.replace('_', ' ')}: {event.sentence}"
        case _:
            by = getattr(event, "by", "")
            return f"{told(event, COMMANDS).what}{f'  ({by})' if by else ''}"
