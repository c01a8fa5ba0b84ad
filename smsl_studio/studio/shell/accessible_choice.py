"""The accessible interface of a combo box, in place of Qt's.

On Linux Qt names a combo box by its present entry alone, so a reader does not learn what is chosen
there. Here it is named by what it chooses, and the entry follows: "Initial state: State000".
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import Any

from PySide6.QtGui import QAccessible, QAccessibleInterface
from PySide6.QtWidgets import QAccessibleWidget, QComboBox
from shiboken6 import isValid

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.canvas.accessible_leaf import MENU, PRESS


class ChoiceAccessible(QAccessibleWidget):
    """A combo box that cannot be typed into. Its child is the list of its entries."""

    def __init__(self, combo: QComboBox) -> None:
        super().__init__(combo, QAccessible.Role.ComboBox, "")

    @property
    def combo(self) -> QComboBox | None:
        """The combo box; None once it is gone."""
        found = self.object() if isValid(self) else None
        return found if isinstance(found, QComboBox) else None

    def text(self, kind: QAccessible.Text) -> str:
        """The name and the present entry. AT-SPI has no place for the entry but the name."""
        combo = self.combo
        if combo is None:
            return ""
        entry = plain_text(combo.currentText())
        if kind == QAccessible.Text.Value:
            return entry
        if kind == QAccessible.Text.Name and sys.platform.startswith("linux"):
            name = combo.accessibleName()
            return f"{name}: {entry}" if name and entry else name or entry
        return super().text(kind)

    def childCount(self) -> int:
        """1: the list of the entries."""
        return 1 if self.combo is not None else 0

    def child(self, index: int) -> Any:
        """The list of the entries; None for another number."""
        combo = self.combo
        if combo is None or index != 0:
            return None
        return QAccessible.queryAccessibleInterface(combo.view())

    def indexOfChild(self, child: QAccessibleInterface) -> int:
        """0 for the list of the entries; -1 for anything else."""
        combo = self.combo
        return 0 if combo is not None and child.object() is combo.view() else -1

    def state(self) -> QAccessible.State:
        """As of any widget, and whether the list is open."""
        found, combo = super().state(), self.combo
        found.expandable = found.hasPopup = True
        found.expanded = combo is not None and combo.view().isVisible()
        found.collapsed = not found.expanded
        return found

    def actionNames(self) -> list[str]:
        """The names of what can be done with it."""
        return [MENU, PRESS, "SetFocus"]

    def localizedActionDescription(self, name: str) -> str:
        """What an action does, in words; empty for an unknown name."""
        acts = {MENU: "Open or close the list", PRESS: "Open or close the list"}
        return acts.get(name, super().localizedActionDescription(name))

    def doAction(self, name: str) -> None:
        """Open or close the list of the entries, or take the keyboard focus."""
        combo = self.combo
        if combo is None or not combo.isEnabled():
            return
        toggle: Callable[[], None]
        toggle = combo.hidePopup if combo.view().isVisible() else combo.showPopup
        if name in (MENU, PRESS):
            toggle()
        else:
            super().doAction(name)
