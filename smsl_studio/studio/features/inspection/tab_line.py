"""The line above the page Inspection: the tabs, and the assumptions of all verdicts."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QGridLayout, QLabel, QSizePolicy, QWidget

from smsl_studio.studio.base.controls import Elided, label
from smsl_studio.studio.base.tabs import tab_bar
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.document.inspector import LIMIT

SHOWN = "Shown for this blueprint as written, if every operation does what its edge says."
SIDES, GAP = 20, 8
"""The space at both sides of the tabs, and between two parts of the line (pixels)."""
VERDICTS, RECOVERABILITY, CONFIGURATION, EQUIVALENCE = range(4)
"""The numbers of the tabs."""
NAMES = ("Verdicts", "Recoverability", "Configuration", "Equivalence")


class TabLine(QWidget):
    """The tabs (``tabs``), and the sentence beside them (``shown``).

    In a narrow page the sentence stands below the tabs, because no verdict is shown without it. In
    a low one its middle is left out there, and the tooltip has it.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setProperty("role", "bar")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.tabs = tab_bar()
        self.tabs.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        self.tabs.setAccessibleName("What the page Inspection shows")
        for name in NAMES:
            self.tabs.addTab(name)
        self.shown: QLabel = Elided(SHOWN)
        self.shown.setProperty("role", "small")
        self.limit = label(f"Limit {LIMIT:,}", "small")
        self.limit.setToolTip(tip_text(f"At most {LIMIT:,} configurations are looked at here"))
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(6, 0, 14, 0)
        self._grid.setHorizontalSpacing(GAP)
        self._grid.setVerticalSpacing(0)
        self._grid.setColumnStretch(1, 1)
        self._grid.addWidget(self.tabs, 0, 0)
        self._below: bool | None = None
        self._high = True
        self._place(False)

    def set_room(self, high: bool) -> None:
        """Say whether the page is so high that there may be a line below the tabs."""
        self._high = high
        self._arrange()

    def _place(self, below: bool) -> None:
        """Put the sentence and the limit beside the tabs, or below them."""
        if below == self._below:
            return
        self._below = below
        for one, left in ((self.shown, 8), (self.limit, 0)):
            one.setContentsMargins(left if below else 0, 2 * below, 0, 4 * below)
        if below:
            self._grid.addWidget(self.shown, 1, 0, 1, 2)
        else:
            self._grid.addWidget(self.shown, 0, 1)
        self._grid.addWidget(self.limit, int(below), 2)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Show the whole sentence, below the tabs if it has no room beside them. Hide the note
        about the limit if it has no room.

        In a very narrow page the tabs can be scrolled. Else the last one would be cut off.
        """
        super().resizeEvent(event)
        self.tabs.setUsesScrollButtons(self.width() < self.tabs.sizeHint().width() + SIDES)
        self.tabs.setMaximumWidth(max(self.width() - SIDES, 1))
        self._arrange()

    def _arrange(self) -> None:
        room = self.width() - SIDES - self.shown.sizeHint().width() - GAP
        told = self.limit.sizeHint().width() + GAP
        beside = room - self.tabs.sizeHint().width() - GAP
        self._place(self._high and beside < told)
        self.limit.setVisible((room if self._below else beside) >= told)
