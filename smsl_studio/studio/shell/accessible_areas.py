"""A replacement for Qt's accessible interface of scroll areas, which can crash the process.

In Qt's interface the children are the parts that are visible at the moment, so a scroll bar is a
child only sometimes. ``child`` does not check its index. If a scroll bar disappears after a reader
has counted the children, the reader gets a child beyond the end of the list, and the process
crashes (seen with Qt 6.11). Here every part is always a child, as in any other widget, and a hidden
one says that it is hidden. So the number stays the same.
"""

from __future__ import annotations

from PySide6.QtCore import QObject
from PySide6.QtGui import QAccessible, QAccessibleInterface
from PySide6.QtWidgets import QAbstractScrollArea, QAccessibleWidget

WITH_QT_S_OWN = ("QScrollArea", "QAbstractScrollArea")
"""The classes with Qt's faulty interface.

Lists, tables and texts have other interfaces, which check the index.
"""


def area_of(class_name: str, thing: QObject) -> QAccessibleInterface | None:
    """The interface of a scroll area; None for all other objects.

    Qt keeps it until the area is deleted.
    """
    if class_name in WITH_QT_S_OWN and isinstance(thing, QAbstractScrollArea):
        return QAccessibleWidget(thing, QAccessible.Role.Client)
    return None
