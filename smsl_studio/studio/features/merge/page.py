"""The page Merge: the drawing over the source at the left, the conflicts at the right."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QSplitter, QStackedLayout, QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.merge import Conflict, Side
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.merge.columns_view import ColumnsView
from smsl_studio.studio.features.merge.conflict_list import WIDTH, ConflictList
from smsl_studio.studio.features.merge.marked_notice import MarkedNotice
from smsl_studio.studio.features.merge.merge_canvas import MergeCanvas
from smsl_studio.studio.features.merge.open_merge import OpenMerge
from smsl_studio.studio.features.merge.preview import ChoicePreview

SOURCE = 224


class MergePage(QWidget):
    """Shows the open merge of a session. Every choice is one step of the history."""

    save_wanted = Signal()
    leave_wanted = Signal()
    merge_wanted = Signal()
    """Merge the text with conflict markers by what it means."""
    opened = Signal()

    def __init__(self, session: Session, merge: OpenMerge, tokens: Tokens) -> None:
        super().__init__()
        self._session, self._merge = session, merge
        self.drawing = MergeCanvas(merge, tokens)
        self.source = ColumnsView(tokens)
        self.list = ConflictList(merge, tokens)
        self.preview = ChoicePreview(self)
        left = QSplitter(Qt.Orientation.Vertical)
        left.addWidget(self.drawing)
        left.addWidget(self.source)
        left.setStretchFactor(0, 1)
        left.setSizes([533, SOURCE])
        left.setChildrenCollapsible(False)
        whole = QSplitter(Qt.Orientation.Horizontal)
        whole.addWidget(left)
        whole.addWidget(self.list)
        whole.setStretchFactor(0, 1)
        whole.setSizes([1044, WIDTH])
        whole.setChildrenCollapsible(False)
        self.notice = MarkedNotice()
        self.notice.merge_wanted.connect(self.merge_wanted)
        self._stack = QStackedLayout(self)
        self._stack.addWidget(self.notice)
        self._stack.addWidget(whole)
        self.setAccessibleName("Merge")
        self._connect()
        self.refresh()

    def _connect(self) -> None:
        self._merge.changed.connect(self.refresh)
        self.list.taken.connect(self._take)
        self.list.previewed.connect(self._preview)
        self.list.selected.connect(self.select)
        self.list.merged_chosen.connect(self.drawing.select)
        self.list.save_wanted.connect(self.save_wanted)
        self.list.leave_wanted.connect(self.leave_wanted)
        self.drawing.clicked.connect(self._clicked)
        self.preview.told.connect(self.list.show_preview)

    def refresh(self) -> None:
        """Show the merge as it is now."""
        self._stack.setCurrentIndex(int(self._merge.exists))
        if not self._merge.exists:
            return
        self.list.show_merge()
        self.list.show_sides()
        current = self.list.current
        if current is not None:
            self._show_lines(current)
        selected = [] if current is None else [Address(*Address.split(current.address))]
        self.drawing.show_result(self._session.blueprint, selected)

    def select(self, conflict: Conflict) -> None:
        """Show a conflict in list, drawing and source."""
        self.list.select(conflict)
        self._show_lines(conflict)
        self.drawing.select([Address(*Address.split(conflict.address))])

    def _show_lines(self, conflict: Conflict) -> None:
        sides = self._merge.sides
        if sides is not None and conflict in self._merge.conflicts:
            number = self._merge.conflicts.index(conflict) + 1
            self.source.show_conflict(conflict, number, sides)

    def showEvent(self, event: QShowEvent) -> None:
        """Tell that somebody looks at the page."""
        super().showEvent(event)
        self.opened.emit()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        for part in (self.drawing, self.source, self.list):
            part.set_tokens(tokens)

    def stop(self) -> None:
        """End all work, because the window closes."""
        self.preview.stop()

    def _take(self, conflict: Conflict, side: Side) -> None:
        # The next one is selected first, so that the drawing follows once.
        self.list.select(self._merge.following(conflict))
        if not self._merge.take(conflict, side):
            self.select(conflict)

    def _preview(self, conflict: Conflict, side: Side | None) -> None:
        if side:
            self.preview.ask(self._session.blueprint, conflict, side)
        else:
            self.preview.drop()
            self.list.show_preview(conflict, "")

    def _clicked(self, address: Address) -> None:
        found = next((one for one in self._merge.conflicts if one.address == str(address)), None)
        if found is not None:
            self.select(found)
        else:
            self.drawing.select([address])
