"""A scroll area for a part that may be taller than the space there is."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, QSize, Qt
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QFrame, QScrollArea, QSizePolicy, QWidget

LEAST = 120


class Room(QScrollArea):
    """Asks for the height of the part in it, and scrolls where there is less."""

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
        """Ask for another size when the part inside has changed its own."""
        if event.type() in (QEvent.Type.LayoutRequest, QEvent.Type.Resize):
            self.updateGeometry()
        return super().eventFilter(watched, event)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Show the scroll bar only where the part does not fit."""
        # Qt leaves a bar standing that was needed a moment ago.
        bar = Qt.ScrollBarPolicy
        fits = self.sizeHint().height() <= self.height()
        self.setVerticalScrollBarPolicy(bar.ScrollBarAlwaysOff if fits else bar.ScrollBarAsNeeded)
        super().resizeEvent(event)

    def sizeHint(self) -> QSize:
        """As high as the part inside at this width."""
        inner = self.widget()
        if inner is None:
            return super().sizeHint()
        # The width without a scroll bar: one that is there must not be why it stays.
        wide = max(self.width(), 200)
        layout = inner.layout()
        high = layout.heightForWidth(wide) if layout and layout.hasHeightForWidth() else -1
        return QSize(wide, high if high > 0 else inner.sizeHint().height())

    def minimumSizeHint(self) -> QSize:
        """High enough to scroll in."""
        return QSize(0, min(LEAST, self.sizeHint().height()))
