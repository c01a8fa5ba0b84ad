"""The line above the page Inspection: the tabs, and the assumptions of all verdicts."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QLabel, QSizePolicy, QWidget

from smsl_studio.studio.base.controls import Elided, label, row
from smsl_studio.studio.base.tabs import tab_bar
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.document.inspector import LIMIT

SHOWN = "Shown for this blueprint as written, if every operation does what its edge says."
NARROW = 1000
"""In a line narrower than this the limit is hidden, because the sentence needs the space
(pixels)."""
SIDES = 20
"""The space at both sides of the tabs (pixels)."""
VERDICTS, RECOVERABILITY, CONFIGURATION, EQUIVALENCE = range(4)
"""The numbers of the tabs."""
NAMES = ("Verdicts", "Recoverability", "Configuration", "Equivalence")


class TabLine(QWidget):
    """The tabs (``tabs``), and the sentence beside them (``shown``)."""

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
        line = row(self.tabs, self.shown, self.limit)
        line.setContentsMargins(6, 0, 14, 0)
        self.setLayout(line)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Hide the limit if the sentence needs the space.

        In a very narrow page the tabs can be scrolled. Else the last one would be cut off.
        """
        super().resizeEvent(event)
        self.tabs.setUsesScrollButtons(self.width() < self.tabs.sizeHint().width() + SIDES)
        self.tabs.setMaximumWidth(max(self.width() - SIDES, 1))
        self.limit.setVisible(self.width() >= NARROW)
