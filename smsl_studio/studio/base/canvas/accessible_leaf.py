"""The accessible interfaces that the parts of a canvas share, with and without children."""

from __future__ import annotations

from typing import Any

from PySide6.QtGui import QAccessible, QAccessibleInterface


class PartAccessible(QAccessibleInterface):
    """An interface without a Qt object. Subclasses give the words and the children."""

    def __init__(self, parent: QAccessibleInterface) -> None:
        super().__init__()
        self._above = parent

    def object(self) -> Any:
        """None: it is no Qt object."""
        return None

    def window(self) -> Any:
        """The window that the canvas lies in."""
        return self._above.window()

    def parent(self) -> QAccessibleInterface:
        """The interface that it is a child of."""
        return self._above

    def setText(self, kind: QAccessible.Text, text: str) -> None:
        """Ignored: the words follow the blueprint and cannot be set from outside."""


class LeafAccessible(PartAccessible):
    """A part without children."""

    def childCount(self) -> int:
        """0: it has no children."""
        return 0

    def child(self, index: int) -> Any:
        """None: it has no children."""
        return None

    def indexOfChild(self, child: QAccessibleInterface) -> int:
        """-1: it has no children."""
        return -1

    def childAt(self, x: int, y: int) -> Any:
        """None: it has no children."""
        return None
