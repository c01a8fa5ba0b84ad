"""The menu of the tools that have no room in the mode bar."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QMenu, QToolButton


class MoreTools(QToolButton):
    """The button whose menu has the tools without room."""

    def __init__(self, every: tuple[QToolButton, ...]) -> None:
        super().__init__()
        self.every, self.tools = every, list[QToolButton]()
        self.setText("…")
        self.setProperty("role", "tool")
        self.setFixedSize(32, 32)
        self.setToolTip("The tools that have no room in this row")
        self.setAccessibleName("More drawing tools")
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        menu = QMenu(self)
        menu.aboutToShow.connect(self._fill)
        self.setMenu(menu)
        self.hide()

    def _fill(self) -> None:
        menu = self.menu()
        menu.clear()
        menu.addActions([tool.defaultAction() for tool in self.tools])
