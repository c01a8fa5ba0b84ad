"""Accessible interfaces for objects whose interface in Qt is missing or faulty."""

from __future__ import annotations

from PySide6.QtCore import QCoreApplication, QObject
from PySide6.QtGui import QAccessible, QAccessibleInterface
from PySide6.QtWidgets import QApplication, QComboBox, QListView, QTabBar, QTreeView
from shiboken6 import getCppPointer, isValid

from smsl_studio.studio.base.canvas.accessible_tree import CanvasAccessible
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.shell.accessible_areas import area_of
from smsl_studio.studio.shell.accessible_choice import ChoiceAccessible
from smsl_studio.studio.shell.accessible_focus import focus_moved
from smsl_studio.studio.shell.accessible_proxies import handing_on
from smsl_studio.studio.shell.accessible_rows import rows_of
from smsl_studio.studio.shell.accessible_tabs import TabsAccessible

INSTALLED = "smsl accessible factory"

QT_S_OWN = (
    "QListView",
    "QListWidget",
    "QTreeView",
    "QTreeWidget",
    "QTabBar",
    "QComboBox",
    "QComboBoxListView",
)
"""Classes of Qt that the window uses itself, with the list inside a combo box. What Qt makes inside
its own dialogs has other names, and keeps Qt's interfaces."""


class Factory:
    """Makes the interface of an object when an assistive tool asks for it.

    Qt calls it with the name of each class of an object, from the most special to the most general.
    """

    def __init__(self) -> None:
        self._kept: dict[int, QAccessibleInterface] = {}

    def __call__(self, class_name: str, thing: QObject) -> QAccessibleInterface | None:
        made = _made(thing)
        if made is None:
            # Only now, because a class may have an interface of its own here.
            made = handing_on(class_name, thing)
        if made is None:
            return area_of(class_name, thing)
        # PySide would free what nobody holds. Qt has deleted the interfaces of what is gone.
        self._kept = {key: one for key, one in self._kept.items() if isValid(one)}
        self._kept[getCppPointer(thing)[0]] = made
        return made


def _made(thing: QObject) -> QAccessibleInterface | None:
    """The interface of an object for which Qt's is missing or faulty; None for all others."""
    if isinstance(thing, Canvas):
        return CanvasAccessible(thing)
    made_of = thing.metaObject().className()
    if made_of.startswith("Q") and made_of not in QT_S_OWN:
        return None
    if isinstance(thing, QListView | QTreeView):
        return rows_of(thing)
    if isinstance(thing, QTabBar):
        return TabsAccessible(thing)
    if isinstance(thing, QComboBox) and not thing.isEditable():
        return ChoiceAccessible(thing)
    return None


def install(application: QCoreApplication) -> None:
    """Install the factory, once for each application."""
    if not application.property(INSTALLED):
        application.setProperty(INSTALLED, True)
        QAccessible.installFactory(Factory())
        if isinstance(application, QApplication):
            application.focusChanged.connect(focus_moved)
