"""The page Monitor of Run: a switch between what is sensed and the room."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from PySide6.QtWidgets import (
    QButtonGroup,
    QFrame,
    QSizePolicy,
    QStackedWidget,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from smsl_studio.studio.base.controls import row, rule
from smsl_studio.studio.base.headed_page import HeadedPage
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.features.monitor.page import MonitorPage

SENSORS, ROOM = "Sensors", "Room"
TIPS = {
    SENSORS: "Every sensor, fact, node and state check of the run",
    ROOM: "The plan of the room with its nodes, and the facts that they feed",
}


class MonitorPages(QWidget):
    """Sensors, and the room if there is one. ``room`` makes its page when it is first shown."""

    def __init__(self, sensors: MonitorPage, room: Callable[[], HeadedPage]) -> None:
        super().__init__()
        self.setAccessibleName("Monitor")
        self.sensors, self._room = sensors, room
        self._made: dict[str, HeadedPage] = {}
        self._heads, self._pages = QStackedWidget(), QStackedWidget()
        self._heads.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.switch = QFrame()
        self.switch.setObjectName("segments")
        self.switch.setFixedHeight(34)
        self.switch.setProperty("tight", "snug")
        self.switch.setAccessibleName("What the monitor shows")
        inner = row(spacing=0)
        inner.setContentsMargins(2, 2, 2, 2)
        group = QButtonGroup(self)
        self.buttons: dict[str, QToolButton] = {}
        for name in (SENSORS, ROOM):
            button = self.buttons[name] = QToolButton()
            button.setText(name)
            button.setCheckable(True)
            button.setFixedHeight(30)
            button.setToolTip(tip_text(TIPS[name]))
            button.clicked.connect(partial(self.show_page, name))
            group.addButton(button)
            inner.addWidget(button)
        self.switch.setLayout(inner)
        top = row(self.switch, self._heads, spacing=12)
        top.setContentsMargins(12, 6, 12, 6)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addLayout(top)
        column.addWidget(rule())
        column.addWidget(self._pages, 1)
        self.offer_room(False)
        self.show_page(SENSORS)

    @property
    def current(self) -> str:
        """The name of the page that is shown."""
        return next(name for name, button in self.buttons.items() if button.isChecked())

    def offer_room(self, offered: bool) -> None:
        """Offer the room, or take it away: then the sensors are shown."""
        self.switch.setVisible(offered)
        if not offered and self.buttons[ROOM].isChecked():
            self.show_page(SENSORS)

    def show_page(self, name: str) -> None:
        """Show one of the two."""
        self.buttons[name].setChecked(True)
        page = self._made.get(name)
        if page is None:
            page = self._made[name] = self.sensors if name == SENSORS else self._room()
            self._heads.addWidget(page.head)
            self._pages.addWidget(page)
        # The hidden one must not make the shown one larger than its room.
        for one in self._made.values():
            policy = QSizePolicy.Policy.Preferred if one is page else QSizePolicy.Policy.Ignored
            for part in (one, one.head):
                part.setSizePolicy(policy, policy)
        self.setFocusProxy(page)
        self._heads.setCurrentWidget(page.head)
        self._pages.setCurrentWidget(page)
