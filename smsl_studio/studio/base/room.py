"""A scroll area for a part that may be taller than the available space."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, QSize, Qt
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QFrame, QScrollArea, QSizePolicy, QWidget

LEAST = 120


class Room(QScrollArea):
    """A scroll area that asks for the height of its part, and scrolls if it gets less."""

    def __init__(self, inner: QWidget) -> None:
        super().__init__()
        inner.setProperty("role", "panel")
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setWidgetResizable(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Maximum)
        self.setWidget(inner)
        inner.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Update the size hint after the part inside changed its size."""
        if event.type() in (QEvent.Type.LayoutRequest, QEvent.Type.Resize):
            self.updateGeometry()
        return super().eventFilter(watched, event)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Show the scroll bar only if the part does not fit."""
        # Qt would keep a scroll bar that is no longer needed.
        bar = Qt.ScrollBarPolicy
        fits = self.sizeHint().height() <= self.height()
        self.setVerticalScrollBarPolicy(bar.ScrollBarAlwaysOff if fits else bar.ScrollBarAsNeeded)
        super().resizeEvent(event)

    def sizeHint(self) -> QSize:
        """The height that the part inside needs at this width."""
        inner = self.widget()
        if inner is None:
            return super().sizeHint()
        # The width without the scroll bar, so that a visible bar is not the reason to keep it.
        wide = max(self.width(), 200)
        layout = inner.layout()
        high = layout.heightForWidth(wide) if layout and layout.hasHeightForWidth() else -1
        return QSize(wide, high if high > 0 else inner.sizeHint().height())

    def minimumSizeHint(self) -> QSize:
        """High enough to scroll in."""
        return QSize(0, min(LEAST, self.sizeHint().height()))
