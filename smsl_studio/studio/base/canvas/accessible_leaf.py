"""The accessible interfaces of the parts of a canvas, a list or tabs, with and without children.

A part has no Qt object of its own, but it derives from Qt's interface of a widget. The reason is
that only interfaces of widgets offer actions: PySide 6.11 crashes if a class overrides
``interface_cast``. The widget is the canvas, and every method that would tell of it is overridden.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from PySide6.QtGui import QAccessible, QAccessibleInterface
from PySide6.QtWidgets import QAccessibleWidget, QWidget

from smsl_studio.studio.base.canvas.accessible_held import HELD

PRESS, MENU, FOCUS = "Press", "ShowMenu", "SetFocus"
"""Qt's names of the actions that every assistive tool knows."""

Call = Callable[..., object]
Acts = Mapping[str, tuple[str, Call]]
"""What can be done with a part: by name, what it does in words, and the call."""
Relation = tuple[QAccessibleInterface, QAccessible.RelationFlag]
ALL = QAccessible.RelationFlag.AllRelations


class PartAccessible(QAccessibleWidget):
    """An interface without a Qt object. Subclasses give the words, the children and the acts."""

    def __init__(self, parent: QAccessibleInterface, widget: QWidget) -> None:
        super().__init__(widget, QAccessible.Role.ListItem, "")
        self._above = parent
        HELD.hold(self)

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

    def focusChild(self) -> Any:
        """None: the canvas has the focus, and tells which part is chosen."""
        return None

    def acts(self) -> Acts:
        """What can be done with it now."""
        return {}

    def actionNames(self) -> list[str]:
        """The names of what can be done with it now."""
        return list(self.acts())

    def localizedActionName(self, name: str) -> str:
        """The name of an action as it is shown: the same."""
        return name

    def localizedActionDescription(self, name: str) -> str:
        """What an action does, in words; empty for an unknown name."""
        return self.acts().get(name, ("", None))[0]

    def doAction(self, name: str) -> None:
        """Do it, if it is possible now."""
        found = self.acts().get(name)
        if found is not None:
            with HELD.at_work():
                found[1]()

    def keyBindingsForAction(self, name: str) -> list[str]:
        """None: the keys belong to the canvas."""
        return []

    def relations(self, match: QAccessible.RelationFlag = ALL) -> list[Relation]:
        """The other parts that it has to do with; none here."""
        return []


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
