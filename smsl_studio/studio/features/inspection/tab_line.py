"""The line above the page Inspection: its tabs, and what every verdict is based on."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QLabel, QSizePolicy, QTabBar, QWidget

from smsl_studio.studio.base.controls import Elided, label, row
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.document.inspector import LIMIT

SHOWN = "Shown for this blueprint as written, if every operation does what its edge says."
NARROW = 1000
"""Below this width the sentence has no room for the limit beside it (pixels)."""
SIDES = 20
"""The room at the sides of the tabs (pixels)."""
VERDICTS, RECOVERABILITY, CONFIGURATION, EQUIVALENCE = range(4)
"""The tabs."""
NAMES = ("Verdicts", "Recoverability", "Configuration", "Equivalence")


class TabLine(QWidget):
    """``tabs`` chooses what the page shows, ``shown`` is the sentence."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setProperty("role", "bar")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.tabs = QTabBar()
        self.tabs.setDrawBase(False)
        self.tabs.setExpanding(False)
        self.tabs.setUsesScrollButtons(False)
        self.tabs.setElideMode(Qt.TextElideMode.ElideNone)
        self.tabs.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        self.tabs.setFocusPolicy(Qt.FocusPolicy.TabFocus)
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
        """Leave the limit out if the sentence needs its place. In a very narrow page the tabs can
        be scrolled, or the last would be cut."""
        super().resizeEvent(event)
        self.tabs.setUsesScrollButtons(self.width() < self.tabs.sizeHint().width() + SIDES)
        self.tabs.setMaximumWidth(max(self.width() - SIDES, 1))
        self.limit.setVisible(self.width() >= NARROW)
