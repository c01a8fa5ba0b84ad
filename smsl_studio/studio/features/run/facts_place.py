"""The lower part of a run: facts and state check beside the lists, or as tabs of the lists."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import QSplitter, QVBoxLayout, QWidget

from smsl_studio.studio.base.panels import empty_panel
from smsl_studio.studio.base.tabs import Tabs
from smsl_studio.studio.running.facts_table import HEADS, ROW, FactsTable
from smsl_studio.studio.running.frames import HEAD
from smsl_studio.studio.running.state_check import StateCheckView

FACTS = 380
"""The smallest width of the facts, so that their words are not cut (pixels)."""
LEAST = HEAD + HEADS + 4 * ROW + 80
"""The smallest height of the facts beside the lists: the line of an SB, three facts, and a state
check of two lines (pixels)."""
LOWEST, TABBED = 110, 2 * HEAD + HEADS + 3 * ROW
"""The smallest heights of the tabs: in the lowest window, and with rows for two facts (pixels)."""
ABOVE = 225
"""What the picture of the world and the timeline need above and below the tabs (pixels)."""
ROOM = QSize(1000, 500)
"""A run page narrower or lower than this has the facts as a tab (pixels)."""
NAMES = "Facts", "Check"


class FactsPlace(QSplitter):
    """What the run believes and senses, beside what is possible. ``head`` stands over the facts."""

    def __init__(
        self, head: QWidget, facts: FactsTable, check: StateCheckView, lists: Tabs
    ) -> None:
        super().__init__(Qt.Orientation.Horizontal)
        self.setHandleWidth(1)
        self.setChildrenCollapsible(False)
        self._head, self._facts, self._check, self.lists = head, facts, check, lists
        self.tabbed = False
        self._beside, self._column = empty_panel()
        self._beside.setMinimumWidth(FACTS)
        self._fill(self._column, head, facts, check)
        for at, part in enumerate((self._beside, lists)):
            self.addWidget(part)
            self.setStretchFactor(at, (45, 55)[at])
        self.setSizes([428, 383])

    def fit(self, page: QSize) -> None:
        """Choose the arrangement for a run page of this size."""
        tabbed = page.width() < ROOM.width() or page.height() < ROOM.height()
        # The tabs ask for a height, or the timeline would take the room of the facts.
        low = max(LOWEST, min(page.height() - ABOVE, TABBED))
        self.setMinimumHeight(low if tabbed else LEAST)
        if tabbed == self.tabbed:
            return
        self.tabbed = tabbed
        if tabbed:
            for name, parts in zip(NAMES, ((self._head, self._facts), (self._check,)), strict=True):
                page_of, column = empty_panel()
                self._fill(column, *parts)
                self.lists.add(name, page_of)
        else:
            self._fill(self._column, self._head, self._facts, self._check)
            for name in NAMES:
                self.lists.remove(name)
        self._beside.setVisible(not tabbed)

    def _fill(self, column: QVBoxLayout, *parts: QWidget) -> None:
        """Put parts into a column, one below another; the table gets the free room."""
        while column.count():
            column.takeAt(0)
        for part in parts:
            column.addWidget(part, 1 if part is self._facts else 0)
            part.show()
        column.addStretch(0)
