"""LatePanel: the place of a panel that is made when somebody first looks at it."""

from __future__ import annotations

from PySide6.QtCore import QSize
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QVBoxLayout, QWidget

from smsl_studio.studio.base.late_part import LatePart, Made

LEAST = 60
"""The least height of the place (pixels), because the panels beside it may be low."""


class LatePanel(QWidget):
    """Is filled by ``part`` as soon as that is made, at the latest when it is shown."""

    def __init__(self, part: LatePart[Made]) -> None:
        super().__init__()
        self._part = part
        self._column = QVBoxLayout(self)
        self._column.setContentsMargins(0, 0, 0, 0)
        part.when_made(self._take)

    def minimumSizeHint(self) -> QSize:
        """The same small size before and after it is filled."""
        return QSize(0, LEAST)

    def showEvent(self, event: QShowEvent) -> None:
        """Make what stands here."""
        super().showEvent(event)
        self._part()

    def _take(self, panel: Made) -> None:
        assert isinstance(panel, QWidget)
        self._column.addWidget(panel)
        # Else Qt would show it a moment later, after what is asked of it now.
        panel.show()
        self.setFocusProxy(panel)
