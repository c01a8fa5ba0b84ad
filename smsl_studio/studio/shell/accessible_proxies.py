"""The accessible interface of a part that hands the keyboard focus on to another part.

Qt says of such a part that it has the focus, too. So a reader would find two that have it.
"""

from __future__ import annotations

from PySide6.QtCore import QObject
from PySide6.QtGui import QAccessible, QAccessibleInterface
from PySide6.QtWidgets import QAccessibleWidget, QApplication, QWidget
from shiboken6 import isValid

ROLES = {"QSplitter": QAccessible.Role.Splitter, "QWidget": QAccessible.Role.Client}
"""The classes that hand the focus on here, and what Qt says they are."""


class HandingOn(QAccessibleWidget):
    """As Qt's, but it has the focus only if it keeps it itself."""

    def state(self) -> QAccessible.State:
        """The flags of any widget."""
        found = super().state()
        part = self.object() if isValid(self) else None
        found.focused = part is not None and QApplication.focusWidget() is part
        return found


def handing_on(class_name: str, thing: QObject) -> QAccessibleInterface | None:
    """The interface of a part with a focus proxy; None for all other objects.

    ``class_name`` is that of the nearest class for which Qt asks, so lists and fields, which come
    before ``QWidget``, keep their interfaces.
    """
    role = ROLES.get(class_name)
    if role is None or not isinstance(thing, QWidget) or thing.focusProxy() is None:
        return None
    return HandingOn(thing, role)
