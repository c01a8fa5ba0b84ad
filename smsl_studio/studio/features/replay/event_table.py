"""The events of a recorded run as lines; a click goes to the moment after an event."""

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
    """The events as a Qt model.

    Their words are made when they are shown, because a run may have 100,000.
    """

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
        """The number of events; an event has no children."""
        return 0 if parent.isValid() else len(self._events)

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> object:
        """The words of an event with its simulated time in seconds.

        The tooltip is its line in the log.
        """
        event = self._events[index.row()]
        if role == Qt.ItemDataRole.ToolTipRole:
            return tip_text(event.line())
        if role not in (Qt.ItemDataRole.DisplayRole, Qt.ItemDataRole.AccessibleTextRole):
            return None
        by = self._by[index.row()]
        what = told(event, COMMANDS, names=self._names).what
        return f"{event.t:7.2f} s  {what}{f'  ({by})' if by else ''}"


class EventTable(QListView):
    """The list of events, with the newest one that has happened selected."""

    index_wanted = Signal(int)
    """int: the number of events up to and including the chosen line."""

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
        """Show the events of another recording; ``by`` says who caused each."""
        self._events.show(events, by, blueprint)

    def show_index(self, index: int) -> None:
        """Select the last of the first ``index`` events."""
        row = self._events.index(index - 1)
        if index > 0:
            self.setCurrentIndex(row)
            self.scrollTo(row)
        else:
            self.clearSelection()
            self.scrollToTop()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Go to the moment of the row that a key selects, so that the selection is always the
        present moment."""
        before = self.currentIndex().row()
        super().keyPressEvent(event)
        if self.currentIndex().row() != before:
            self._choose(self.currentIndex())

    def _choose(self, index: QModelIndex) -> None:
        self.index_wanted.emit(index.row() + 1)
