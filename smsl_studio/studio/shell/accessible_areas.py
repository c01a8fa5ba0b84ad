"""What scroll areas are for assistive tools.

Qt has an interface for them whose children are those parts that are shown just then: a scroll bar
is one while there is something to scroll. ``child`` does not look how many there are, so a reader
who counted before the scroll bar went reads beyond the end of a list, and the process dies
(seen with Qt 6.11). Here every part is a child all the time, as with any other widget, and one that
is hidden says so: the count stays, and there is no child beyond it.
"""

from __future__ import annotations

from PySide6.QtCore import QObject
from PySide6.QtGui import QAccessible, QAccessibleInterface
from PySide6.QtWidgets import QAbstractScrollArea, QAccessibleWidget

WITH_QT_S_OWN = ("QScrollArea", "QAbstractScrollArea")
"""The classes that Qt has the interface for; lists, tables and texts have others, which do look."""


def area_of(class_name: str, thing: QObject) -> QAccessibleInterface | None:
    """The interface of a scroll area; None for all else. Qt keeps it until the area goes."""
    if class_name in WITH_QT_S_OWN and isinstance(thing, QAbstractScrollArea):
        return QAccessibleWidget(thing, QAccessible.Role.Client)
    return None
