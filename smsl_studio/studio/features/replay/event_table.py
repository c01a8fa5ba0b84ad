"""All events of a recorded run, line by line; a click goes to the moment after one."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QAbstractListModel, QModelIndex, QPersistentModelIndex, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QAbstractItemView, QFrame, QListView, QWidget

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.picture.account_words import told
from smsl_studio.runlog.events import Event
from smsl_studio.runlog.names import NAMELESS, HeaderNames, names_of
from smsl_studio.studio.base.controls import NameDelegate
from smsl_studio.studio.base.theme import mono_font
from smsl_studio.studio.base.tips import tip_text

Index = QModelIndex | QPersistentModelIndex


class EventsModel(QAbstractListModel):
    """The words of an event are made when they are looked at: a run may have 100,000."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self._events: Sequence[Event] = ()
        self._by: Sequence[str] = ()
        self._names = NAMELESS

    def show(self, events: Sequence[Event], by: Sequence[str], blueprint: Blueprint) -> None:
        """Show the events of another run; ``by`` says who caused each."""
        self.beginResetModel()
        self._events, self._names = events, HeaderNames.of_header(names_of(blueprint))
        self._by = by
        self.endResetModel()

    def rowCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008
        """How many events there are; an event has no rows below it."""
        return 0 if parent.isValid() else len(self._events)

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> object:
        """The words of an event, with its time in simulated seconds; the tip is its record."""
        event = self._events[index.row()]
        if role == Qt.ItemDataRole.ToolTipRole:
            return tip_text(event.line())
        if role not in (Qt.ItemDataRole.DisplayRole, Qt.ItemDataRole.AccessibleTextRole):
            return None
        by = self._by[index.row()]
        what = told(event, COMMANDS, names=self._names).what
        return f"{event.t:7.2f} s  {what}{f'  ({by})' if by else ''}"


class EventTable(QListView):
    """The line of the newest event that has happened is marked."""

    index_wanted = Signal(int)
    """So many events have happened after the line that was chosen."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._events = EventsModel(self)
        self.setModel(self._events)
        self.setItemDelegate(NameDelegate(self))
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setObjectName("events")
        self.setFont(mono_font(12))
        self.setUniformItemSizes(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setTextElideMode(Qt.TextElideMode.ElideRight)
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setAccessibleName("Events of the recording")
        self.clicked.connect(self._choose)
        self.activated.connect(self._choose)

    def show_events(self, events: Sequence[Event], by: Sequence[str], blueprint: Blueprint) -> None:
        """The events of another recording, and whose command each of them answers."""
        self._events.show(events, by, blueprint)

    def show_index(self, index: int) -> None:
        """So many of them have happened."""
        row = self._events.index(index - 1)
        if index > 0:
            self.setCurrentIndex(row)
            self.scrollTo(row)
        else:
            self.clearSelection()
            self.scrollToTop()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """The row that the keys lead to is the moment that is shown: one mark, one meaning."""
        before = self.currentIndex().row()
        super().keyPressEvent(event)
        if self.currentIndex().row() != before:
            self._choose(self.currentIndex())

    def _choose(self, index: QModelIndex) -> None:
        self.index_wanted.emit(index.row() + 1)
